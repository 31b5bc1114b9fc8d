#include "pipeline/engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <latch>
#include <thread>

#include "pipeline/text_stage.h"

namespace skinforge {
namespace {
using testing::bytes_of;
using testing::Counter;
using testing::counter;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::Text;
using testing::text_stage;

// source -> a -> b -> d, source -> c -> d. `a` keeps one letter, so most changes of its parameter stop there.
struct Diamond {
  std::string a = "A1", b = "B", c = "C", d = "D";
  std::string source = "s";
  Counter a_runs = counter(), b_runs = counter(), c_runs = counter(), d_runs = counter();

  void add_to(Engine& engine) const {
    engine.put_source("source", Text{source});
    auto first = text_stage("first", {"source"}, {"a"}, a, a_runs);
    first->keep = 1;
    engine.add(text_stage("last", {"b", "c"}, {"d"}, d, d_runs));  // order of adding is not order of running
    engine.add(std::move(first));
    engine.add(text_stage("second", {"a"}, {"b"}, b, b_runs));
    engine.add(text_stage("third", {"source"}, {"c"}, c, c_runs));
  }
  std::string build(Cache& cache, std::size_t jobs = 1) const {
    Engine engine(cache, {.jobs = jobs, .session = "diamond"});
    add_to(engine);
    engine.run();
    EXPECT_TRUE(engine.is_ok());
    return engine.get<Text>("d").value;
  }
  std::vector<int> runs() const { return {*a_runs, *b_runs, *c_runs, *d_runs}; }
};

std::map<std::string, StageResult> by_label(const Engine& engine) {
  std::map<std::string, StageResult> results;
  for (const StageResult& result : engine.results()) results[result.info.label()] = result;
  return results;
}

// By hand: a = "A" (cut), b = "B" + a, c = "C" + source, d = "D" + b + c.
TEST(Engine, RunsStagesInTheOrderOfTheirArtifacts) {
  MemoryStore store;
  Cache cache(store);
  EXPECT_EQ(Diamond().build(cache), "DBACs");
}

TEST(Engine, SecondBuildRunsNothing) {
  MemoryStore store;
  Diamond diamond;
  for (int build = 0; build < 2; ++build) {
    Cache cache(store);
    EXPECT_EQ(diamond.build(cache), "DBACs");
  }
  EXPECT_THAT(diamond.runs(), ElementsAre(1, 1, 1, 1));
}

TEST(Engine, EqualBytesStopTheChain) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  diamond.build(cache);
  diamond.a = "A2";  // another key for `first`, but the same output after the cut
  diamond.build(cache);
  EXPECT_THAT(diamond.runs(), ElementsAre(2, 1, 1, 1));
}

TEST(Engine, AChangeRunsWhatDependsOnItAndNothingElse) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  diamond.build(cache);
  diamond.b = "b";
  EXPECT_EQ(diamond.build(cache), "DbACs");
  EXPECT_THAT(diamond.runs(), ElementsAre(1, 2, 1, 2));
  diamond.source = "t";  // `first` cuts its input away
  EXPECT_EQ(diamond.build(cache), "DbACt");
  EXPECT_THAT(diamond.runs(), ElementsAre(2, 2, 2, 3));
}

// The bytes stored for "d" are no text; a hit does not look.
TEST(Engine, AHitStaysUndecodedUntilSomebodyAsks) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  Engine first(cache, {});
  diamond.add_to(first);
  first.run();
  Manifest last = cache.find(first.results().front().key).value();
  const Bytes garbage(3, std::byte{0xff});
  last.outputs.front().digest = sha256(garbage);
  last.outputs.front().size = garbage.size();
  cache.put_blob(sha256(garbage), garbage);
  cache.put(last);

  Engine engine(cache, {});
  diamond.add_to(engine);
  engine.run();
  EXPECT_TRUE(engine.is_ok());
  EXPECT_THAT(diamond.runs(), ElementsAre(1, 1, 1, 1));
  EXPECT_THAT(cache.take_warnings(), IsEmpty());
  EXPECT_THROW(engine.get<Text>("d"), Error);
}

// A byte in the middle of each result: same name, same length.
TEST(Engine, AHitIsCheckedToTheLastByte) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  diamond.build(cache);
  for (auto& [path, bytes] : store.entries)
    if (path.starts_with("cas/")) bytes[bytes.size() / 2] ^= std::byte{1};
  EXPECT_EQ(diamond.build(cache), "DBACs");
  EXPECT_THAT(diamond.runs(), ElementsAre(2, 2, 2, 2));
  EXPECT_THAT(cache.take_warnings(), SizeIs(1));
  EXPECT_THAT(cache.verify(), IsEmpty());
}

// What is damaged after a stage was called a hit is noticed when it is read.
TEST(Engine, DamageBehindAHitIsNoticedAtTheReader) {
  MemoryStore store;
  Cache cache(store);
  const auto first_batch = [](Engine& engine) { engine.add(text_stage("maker", {}, {"a"}, "A")); };
  {
    Engine engine(cache, {});
    first_batch(engine);
    engine.run();
  }
  Engine engine(cache, {});
  first_batch(engine);
  engine.run();
  store.entries.at("cas/" + engine.digest("a").hex()).back() ^= std::byte{1};
  engine.add(text_stage("reader", {"a"}, {"b"}, "B"));
  engine.run();
  EXPECT_EQ(engine.get<Text>("b").value, "BA");
  EXPECT_EQ(engine.results().front().status, StageStatus::Ran);
  EXPECT_THAT(cache.take_warnings(), SizeIs(1));
}

// Hands its input on under another name.
struct PassingStage final : Stage {
  StageInfo info() const override { return {.name = "pass", .reads = {"a"}, .writes = {"same"}}; }
  void add_to_key(Hasher&) const override {}
  void run(const StageInput& in, StageOutput& out, IssueSink&) const override { out.pass("same", in, "a"); }
};

TEST(Engine, AnInputPassedOnIsReadUnderBothNamesAndStoredOnce) {
  MemoryStore store;
  for (int build = 0; build < 2; ++build) {
    Cache cache(store);
    Engine engine(cache, {});
    Diamond().add_to(engine);
    engine.add(std::make_unique<PassingStage>());
    engine.run();
    ASSERT_TRUE(engine.is_ok());
    EXPECT_EQ(engine.digest("same"), engine.digest("a"));
    EXPECT_EQ(engine.get<Text>("same").value, "A");
    EXPECT_EQ(engine.bytes("same"), engine.bytes("a"));
  }
}

TEST(Engine, AValueInMemoryGivesItsBytesWhenTheCacheLostThem) {
  MemoryStore store;
  Cache cache(store);
  Engine engine(cache, {});
  Diamond().add_to(engine);
  engine.run();
  const Bytes stored = engine.bytes("d");
  std::erase_if(store.entries, [](const auto& entry) { return entry.first.starts_with("cas/"); });
  EXPECT_EQ(engine.bytes("d"), stored);
}

TEST(Engine, BytesAreStoredRaw) {
  struct RawStage final : Stage {
    StageInfo info() const override { return {.name = "raw", .writes = {"file"}}; }
    void add_to_key(Hasher&) const override {}
    void run(const StageInput&, StageOutput& out, IssueSink&) const override {
      out.put("file", bytes_of("xyz"));
    }
  };
  MemoryStore store;
  Cache cache(store);
  Engine engine(cache, {});
  engine.add(std::make_unique<RawStage>());
  engine.run();
  EXPECT_EQ(engine.bytes("file"), bytes_of("xyz"));
  EXPECT_EQ(engine.digest("file"), sha256(bytes_of("xyz")));
  EXPECT_EQ(store.entries.at("cas/" + sha256(bytes_of("xyz")).hex()), bytes_of("xyz"));
}

TEST(Engine, TakesASecondBatch) {
  MemoryStore store;
  Cache cache(store);
  Engine engine(cache, {.jobs = 2});
  engine.put_source("source", Text{"s"});
  engine.add(text_stage("one", {"source"}, {"a"}, "A"));
  engine.run();
  const std::string clip = engine.get<Text>("a").value;
  engine.add(text_stage("two", {"a", "source"}, {"b"}, clip + "!"));
  engine.run();
  EXPECT_EQ(engine.get<Text>("b").value, "As!Ass");
  EXPECT_THAT(engine.results(), SizeIs(2));
}

// The instance is no part of the key, so a stage whose result depends on it has a twin with other bytes. Both
// wait for each other, so that neither is a hit.
TEST(Engine, NoticesAParameterThatIsMissingFromTheKey) {
  struct Named final : Stage {
    std::string name;
    bool is_honest;
    std::latch& both;
    Named(std::string n, bool honest, std::latch& b) : name(std::move(n)), is_honest(honest), both(b) {}
    StageInfo info() const override { return {.name = "import", .instance = name, .writes = {name}}; }
    void add_to_key(Hasher&) const override {}
    void run(const StageInput&, StageOutput& out, IssueSink&) const override {
      both.arrive_and_wait();
      out.put(name, Text{is_honest ? "same" : name});
    }
  };
  for (const bool is_honest : {true, false}) {
    MemoryStore store;
    Cache cache(store);
    Engine engine(cache, {.jobs = 2});
    std::latch both(2);
    engine.add(std::make_unique<Named>("horse", is_honest, both));
    engine.add(std::make_unique<Named>("pony", is_honest, both));
    engine.run();
    EXPECT_EQ(engine.is_ok(), is_honest);
    EXPECT_EQ(engine.has("horse") && engine.has("pony"), is_honest);
    for (const StageResult& result : engine.results()) {
      if (result.status != StageStatus::Failed) continue;
      EXPECT_EQ(result.code, ExitCode::NotReproducible);
      EXPECT_THAT(result.error, HasSubstr("a parameter is missing from add_to_key"));
    }
  }
}

TEST(Engine, RunsOnlyWhatAnArtifactNeeds) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  Engine engine(cache, {});
  diamond.add_to(engine);
  EXPECT_THAT(engine.stages(), SizeIs(4));
  engine.run_for({"b"});
  EXPECT_THAT(diamond.runs(), ElementsAre(1, 1, 0, 0));
  EXPECT_THAT(engine.results(), SizeIs(2));
  EXPECT_FALSE(engine.has("d"));
  engine.run();
  EXPECT_THAT(diamond.runs(), ElementsAre(1, 1, 1, 1));
  EXPECT_THROW(engine.run_for({"nothing"}), Error);
}

TEST(Engine, AFailedStageTakesOnlyItsDependentsWithIt) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  Engine engine(cache, {});
  engine.put_source("source", Text{"s"});
  auto failing = text_stage("first", {"source"}, {"a"}, "A");
  failing->extra = [](IssueSink&) {
    throw Error(ExitCode::BadInput, "man.fbx: importer crashed (signal 11)");
  };
  engine.add(std::move(failing));
  engine.add(text_stage("second", {"a"}, {"b"}, "B"));
  engine.add(text_stage("third", {"source"}, {"c"}, "C"));
  engine.add(text_stage("last", {"b", "c"}, {"d"}, "D"));
  engine.run();
  const auto results = by_label(engine);
  EXPECT_EQ(results.at("first").status, StageStatus::Failed);
  EXPECT_EQ(results.at("first").code, ExitCode::BadInput);
  EXPECT_EQ(results.at("first").error, "man.fbx: importer crashed (signal 11)");
  EXPECT_EQ(results.at("second").status, StageStatus::Skipped);
  EXPECT_EQ(results.at("second").reason, "first failed");
  EXPECT_EQ(results.at("third").status, StageStatus::Ran);
  EXPECT_EQ(results.at("last").status, StageStatus::Skipped);
  EXPECT_EQ(results.at("last").reason, "second was skipped");
  EXPECT_FALSE(engine.is_ok());
  EXPECT_FALSE(engine.has("a"));
  EXPECT_TRUE(engine.has("c"));
}

TEST(Engine, AFailureIsNotStored) {
  MemoryStore store;
  Cache cache(store);
  const Counter runs = counter();
  for (int build = 0; build < 2; ++build) {
    Engine engine(cache, {});
    auto failing = text_stage("first", {}, {"a"}, "A", runs);
    failing->extra = [](IssueSink&) { throw std::runtime_error("what a library says"); };
    engine.add(std::move(failing));
    engine.run();
    EXPECT_EQ(engine.results().at(0).code, ExitCode::Internal);
    EXPECT_EQ(engine.results().at(0).error, "what a library says");
  }
  EXPECT_EQ(*runs, 2);
  EXPECT_THAT(store.list("ac"), IsEmpty());
}

TEST(Engine, IssuesAreToldAgainOnAHit) {
  MemoryStore store;
  Cache cache(store);
  for (const StageStatus expected : {StageStatus::Ran, StageStatus::Hit}) {
    Engine engine(cache, {});
    auto stage = text_stage("first", {}, {"a"}, "A");
    stage->extra = [](IssueSink& issues) { issues.warn("odd", "man.fbx", "3 weights were not finite"); };
    engine.add(std::move(stage));
    engine.run();
    const StageResult result = engine.results().at(0);
    EXPECT_EQ(result.status, expected);
    ASSERT_THAT(result.issues, SizeIs(1));
    EXPECT_EQ(result.issues[0].code, "odd");
    EXPECT_EQ(result.issues[0].severity, Severity::Warning);
    EXPECT_EQ(result.issues[0].place, "man.fbx");
    EXPECT_EQ(result.issues[0].message, "3 weights were not finite");
  }
}

// Everything but the entries' cost is the same for any number of jobs.
TEST(Engine, TheNumberOfJobsChangesNoByte) {
  const auto blobs_after = [](std::size_t jobs) {
    MemoryStore store;
    Cache cache(store);
    Engine engine(cache, {.jobs = jobs});
    engine.put_source("source", Text{"s"});
    for (int i = 0; i < 40; ++i) {
      const std::string n = std::to_string(i);
      engine.add(text_stage("wide" + n, {"source"}, {"w" + n}, n));
      engine.add(
          text_stage("deep" + n, {"w" + n, i == 0 ? "source" : "x" + std::to_string(i - 1)}, {"x" + n}, "-"));
    }
    engine.run();
    EXPECT_TRUE(engine.is_ok());
    std::vector<std::string> names;
    for (const StageResult& result : engine.results()) names.push_back(result.info.name + result.key.hex());
    for (const auto& [path, bytes] : store.entries)
      if (path.starts_with("cas/")) names.push_back(path);
    return names;
  };
  const auto one = blobs_after(1);
  EXPECT_EQ(one, blobs_after(2));
  EXPECT_EQ(one, blobs_after(8));
}

TEST(Engine, MistakesInTheGraphAreNamed) {
  MemoryStore store;
  Cache cache(store);
  const auto message = [&](auto&& prepare) {
    Engine engine(cache, {});
    try {
      prepare(engine);
      engine.run();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::Internal);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message([](Engine& e) { e.add(text_stage("one", {"x"}, {"a"}, "")); }),
              HasSubstr("nobody makes artifact \"x\""));
  EXPECT_THAT(message([](Engine& e) {
                e.add(text_stage("one", {}, {"a"}, ""));
                e.add(text_stage("two", {}, {"a"}, ""));
              }),
              HasSubstr("artifact \"a\" has two makers"));
  EXPECT_THAT(message([](Engine& e) {
                e.add(text_stage("one", {"b"}, {"a"}, ""));
                e.add(text_stage("two", {"a"}, {"b"}, ""));
              }),
              HasSubstr("in a circle"));
}

struct Misbehaving final : Stage {
  int what;
  explicit Misbehaving(int w) : what(w) {}
  StageInfo info() const override { return {.name = "bad", .writes = {"a"}}; }
  void add_to_key(Hasher&) const override {}
  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    if (what == 0) in.get<Text>("undeclared");
    if (what == 1) out.put("undeclared", Text{});
  }
};

TEST(Engine, AStageSeesOnlyWhatItDeclared) {
  const std::vector<std::string> expected = {"\"undeclared\" is read but not declared",
                                             "\"undeclared\" is written but not declared",
                                             "\"a\" is declared but not written"};
  for (int what = 0; what < 3; ++what) {
    MemoryStore store;
    Cache cache(store);
    Engine engine(cache, {});
    engine.add(std::make_unique<Misbehaving>(what));
    engine.run();
    EXPECT_THAT(engine.results().at(0).error, HasSubstr(expected[what]));
  }
}

TEST(Engine, SourcesMayBeLoadedLate) {
  MemoryStore store;
  Cache cache(store);
  const Bytes bytes = to_bytes(Text{"late"});
  int loads = 0;
  for (int build = 0; build < 2; ++build) {
    Engine engine(cache, {});
    engine.put_source("file", sha256(bytes), bytes.size(), [&] {
      ++loads;
      return bytes;
    });
    engine.add(text_stage("one", {"file"}, {"a"}, ""));
    engine.run();
    EXPECT_EQ(engine.get<Text>("a").value, "late");
  }
  EXPECT_EQ(loads, 1);  // the hit needs the digest only
}

TEST(Engine, ASourceThatChangedIsAnError) {
  MemoryStore store;
  Cache cache(store);
  Engine engine(cache, {});
  engine.put_source("horse.glb", sha256(bytes_of("before")), 6, [] { return bytes_of("after!"); });
  engine.add(text_stage("one", {"horse.glb"}, {"a"}, ""));
  engine.run();
  EXPECT_EQ(engine.results().at(0).error, "horse.glb: changed while it was read");
  EXPECT_EQ(engine.results().at(0).code, ExitCode::BadInput);
}

// ---- plan and reasons

std::vector<std::string> plan_lines(Engine& engine) {
  std::vector<std::string> lines;
  for (const StagePlan& plan : engine.plan()) {
    const char* state = plan.state == PlanState::Hit ? "hit" : plan.state == PlanState::Run ? "run" : "waits";
    lines.push_back(plan.info.label() + ": " + state + (plan.reason.empty() ? "" : ", " + plan.reason));
  }
  return lines;
}

TEST(Plan, SaysWhatWouldRunAndWhy) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  const auto plan = [&](std::string build = kVersion) {
    Engine engine(cache, {.build = build, .session = "diamond"});
    diamond.add_to(engine);
    return plan_lines(engine);
  };
  EXPECT_THAT(plan(), ElementsAre("last: waits, waits for second", "first: run, never run",
                                  "second: waits, waits for first", "third: run, never run"));
  diamond.build(cache);
  EXPECT_THAT(plan(), ElementsAre("last: hit", "first: hit", "second: hit", "third: hit"));
  EXPECT_THAT(diamond.runs(), ElementsAre(1, 1, 1, 1));  // planning runs nothing

  diamond.c = "C2";
  EXPECT_THAT(plan(), ElementsAre("last: waits, waits for third", "first: hit", "second: hit",
                                  "third: run, parameter parameter: C -> C2"));
  diamond.c = "C";
  diamond.source = "t";
  EXPECT_THAT(plan(), ElementsAre("last: waits, waits for second", "first: run, input source changed",
                                  "second: waits, waits for first", "third: run, input source changed"));
  diamond.source = "s";
  EXPECT_THAT(plan("9.9"), ElementsAre("last: waits, waits for second", "first: run, the tool changed",
                                       "second: waits, waits for first", "third: run, the tool changed"));
}

TEST(Plan, NoticesAMissingEntry) {
  MemoryStore store;
  Cache cache(store);
  Engine engine(cache, {.session = "x"});
  engine.add(text_stage("one", {}, {"a"}, "A"));
  engine.run();
  store.entries.erase("ac/" + engine.results().at(0).key.hex());
  Engine again(cache, {.session = "x"});
  again.add(text_stage("one", {}, {"a"}, "A"));
  EXPECT_THAT(plan_lines(again), ElementsAre("one: run, its cache entry is missing or damaged"));
}

// What a stage found odd is an artifact, so a later stage can report it; the same for a hit.
TEST(Engine, IssuesAreAnArtifactOfEachStage) {
  struct Lister final : Stage {
    StageInfo info() const override {
      return {.name = "list", .reads = {issues_artifact("a")}, .writes = {"codes"}};
    }
    void add_to_key(Hasher&) const override {}
    void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
      std::string codes;
      for (const Issue& issue : in.get<std::vector<Issue>>(issues_artifact("a"))) codes += issue.code;
      out.put("codes", Text{codes});
    }
  };
  MemoryStore store;
  Cache cache(store);
  for (int round = 0; round < 2; ++round) {
    Engine engine(cache, {});
    auto odd = text_stage("odd", {}, {"a"}, "A");
    odd->extra = [](IssueSink& issues) { issues.note("odd-thing", "a", "it is odd"); };
    engine.add(std::move(odd));
    if (round == 1) engine.add(std::make_unique<Lister>());
    engine.run();
    EXPECT_EQ(engine.results().at(0).status, round == 0 ? StageStatus::Ran : StageStatus::Hit);
    if (round == 1) {
      EXPECT_EQ(engine.get<Text>("codes").value, "odd-thing");
    }
  }
}

TEST(Plan, ResultsSayWhyAStageRan) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  diamond.build(cache);
  diamond.b = "b";
  Engine engine(cache, {.session = "diamond"});
  diamond.add_to(engine);
  engine.run();
  const auto results = by_label(engine);
  EXPECT_EQ(results.at("second").reason, "parameter parameter: B -> b");
  EXPECT_EQ(results.at("last").reason, "input b changed");
  EXPECT_EQ(results.at("third").status, StageStatus::Hit);
  EXPECT_EQ(results.at("third").reason, "");
}

// By hand: first run scale 1; then 2 and a stage behind it fails; so its key, and the setting that led to it,
// are of the first run when it runs at last.
TEST(Explain, ComparesWithTheRunThatGaveTheKey) {
  MemoryStore store;
  Cache cache(store);
  const auto add_stages = [&](const std::string& scale, bool fails, Engine& engine) {
    engine.add(text_stage("place", {}, {"a"}, scale));
    auto field = text_stage("field", {"a"}, {"b"}, "options " + scale);
    if (fails) field->extra = [](IssueSink&) { throw Error(ExitCode::StageFailed, "no"); };
    engine.add(std::move(field));
  };
  const auto options = [](const std::string& scale) {
    return EngineOptions{
        .session = "x",
        .settings = {{"/scale", scale}, {"/other", "0"}},
        .reads_setting = [](const StageInfo&, std::string_view name) { return name == "/scale"; }};
  };
  for (const bool fails : {false, true}) {
    const std::string scale = fails ? "2" : "1";
    Engine engine(cache, options(scale));
    add_stages(scale, fails, engine);
    engine.run();
  }
  Engine third(cache, options("2"));
  add_stages("2", false, third);
  const std::vector<StagePlan> plans = third.plan();
  EXPECT_THAT(plans[0].changes, IsEmpty());
  EXPECT_EQ(why_run(plans[1].changes),
            "/scale: 1 -> 2; parameter parameter: options 1 -> options 2; input a changed");
  ASSERT_THAT(cache.past_runs("x"), SizeIs(1));
  EXPECT_EQ(why_run(third.changes_since(cache.past_runs("x")[0])[0]), "/scale: 1 -> 2");
}

TEST(Engine, FailuresThatWouldComeAgainAreRemembered) {
  MemoryStore store;
  Cache cache(store);
  const Counter runs = counter();
  const auto build = [&](const std::string& parameter, bool retry, ExitCode code) {
    Engine engine(cache,
                  {.remembers_failure = [](const StageInfo&, ExitCode c) { return c == ExitCode::Usage; },
                   .retry_failed = retry});
    auto failing = text_stage("first", {}, {"a"}, parameter, runs);
    failing->extra = [code](IssueSink&) {
      if (code != ExitCode::Ok) throw Error(code, "x.json:1:2: no joint");
    };
    engine.add(std::move(failing));
    engine.run();
    return engine.results().at(0);
  };
  EXPECT_FALSE(build("A", false, ExitCode::Usage).is_remembered);
  const StageResult second = build("A", false, ExitCode::Usage);
  EXPECT_TRUE(second.is_remembered);
  EXPECT_EQ(second.status, StageStatus::Failed);
  EXPECT_EQ(second.code, ExitCode::Usage);
  EXPECT_EQ(second.error, "x.json:1:2: no joint");
  EXPECT_EQ(*runs, 1);
  build("B", false, ExitCode::StageFailed);  // another key, and a failure that may pass
  build("B", false, ExitCode::StageFailed);
  EXPECT_EQ(*runs, 3);
  EXPECT_EQ(build("A", true, ExitCode::Ok).status, StageStatus::Ran);
  EXPECT_EQ(build("A", false, ExitCode::Ok).status, StageStatus::Hit);
  EXPECT_THAT(store.list("failures"), IsEmpty());
}

// ---- damage

// Each entry of a warm cache in turn is flipped, cut, emptied or deleted; the result stays right, and
// afterwards the cache is whole again.
TEST(Damage, IsAMissAWarningAndARepair) {
  MemoryStore warm;
  {
    Cache cache(warm);
    Diamond().build(cache);
  }
  const std::vector<std::function<void(Bytes&)>> damages = {
      [](Bytes& b) { b[b.size() / 2] ^= std::byte{4}; }, [](Bytes& b) { b.resize(b.size() - 1); },
      [](Bytes& b) { b.clear(); }, [](Bytes& b) { b.push_back(std::byte{0}); }};
  for (const auto& [path, whole] : warm.entries) {
    if (path.starts_with("runs/")) continue;  // holds reasons only
    for (std::size_t kind = 0; kind <= damages.size(); ++kind) {
      SCOPED_TRACE(path + " damage " + std::to_string(kind));
      MemoryStore store;
      store.entries = warm.entries;
      if (kind < damages.size())
        damages[kind](store.entries.at(path));
      else
        store.entries.erase(path);
      Cache cache(store);
      Engine engine(cache, {.session = "diamond"});
      Diamond().add_to(engine);
      engine.run();
      EXPECT_TRUE(engine.is_ok());
      for (const char* name : {"a", "b", "c", "d"}) {
        engine.get<Text>(name);
        engine.get<std::vector<Issue>>(issues_artifact(name));
      }
      EXPECT_EQ(engine.get<Text>("d").value, "DBACs");
      const bool is_plain_miss = kind == damages.size() && path.starts_with("ac/");
      EXPECT_THAT(cache.take_warnings(), SizeIs(is_plain_miss ? 0 : 1));
      EXPECT_THAT(cache.verify(), IsEmpty());
      EXPECT_EQ(store.entries.count(path), 1);
    }
  }
}

TEST(Damage, EntriesThatWereSwappedAreNotBelieved) {
  MemoryStore store;
  Cache cache(store);
  Diamond().build(cache);
  const auto manifests = store.list("ac");
  std::swap(store.entries.at("ac/" + manifests[0].name), store.entries.at("ac/" + manifests[1].name));
  EXPECT_EQ(Diamond().build(cache), "DBACs");
  EXPECT_THAT(cache.take_warnings(), SizeIs(1));
}

// Gives other bytes each time, under one key.
struct Drifting final : Stage {
  StageInfo info() const override { return {.name = "drifting", .writes = {"a"}}; }
  void add_to_key(Hasher&) const override {}
  void run(const StageInput&, StageOutput& out, IssueSink&) const override {
    static int run = 0;
    out.put("a", Text{std::to_string(++run)});
  }
};

TEST(Damage, AResultThatCannotBeMadeAgainFailsTheReader) {
  MemoryStore store;
  Cache cache(store);
  for (int build = 0; build < 2; ++build) {
    Engine engine(cache, {});
    engine.add(std::make_unique<Drifting>());
    engine.run();
    if (build == 1) store.entries.at("cas/" + engine.digest("a").hex()).back() ^= std::byte{1};
    engine.add(text_stage("reader", {"a"}, {"b"}, std::to_string(build)));
    engine.run();
    if (build == 0) {
      EXPECT_TRUE(engine.is_ok());
    } else {
      EXPECT_EQ(engine.results().at(1).code, ExitCode::NotReproducible);
      EXPECT_THAT(engine.results().at(1).error, HasSubstr("stage drifting made other bytes"));
    }
  }
}

TEST(Damage, ACacheThatCannotBeWrittenCostsOneWarning) {
  MemoryStore store;
  store.is_read_only = true;
  Cache cache(store);
  EXPECT_EQ(Diamond().build(cache), "DBACs");
  const auto warnings = cache.take_warnings();
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(warnings[0].code, "cache-not-writable");
}

TEST(Verify, RunsWhatIsKnownAndFindsItEqual) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  diamond.build(cache);
  const auto stored = store.entries;
  Engine engine(cache, {.session = "diamond", .verify = true});
  diamond.add_to(engine);
  engine.run();
  EXPECT_TRUE(engine.is_ok());
  EXPECT_THAT(diamond.runs(), ElementsAre(2, 2, 2, 2));
  EXPECT_EQ(by_label(engine)["second"].status, StageStatus::Ran);
  EXPECT_EQ(by_label(engine)["second"].reason, "run again to compare");
  EXPECT_EQ(engine.get<Text>("d").value, "DBACs");
  EXPECT_EQ(store.entries, stored);
}

TEST(Verify, RunsOnceWhatIsNotKnown) {
  MemoryStore store;
  Cache cache(store);
  Diamond diamond;
  Engine engine(cache, {.verify = true});
  diamond.add_to(engine);
  engine.run();
  EXPECT_TRUE(engine.is_ok());
  EXPECT_THAT(diamond.runs(), ElementsAre(1, 1, 1, 1));
}

TEST(Verify, NamesTheStageThatGivesOtherBytes) {
  MemoryStore store;
  Cache cache(store);
  for (const bool verify : {false, true}) {
    Engine engine(cache, {.verify = verify});
    engine.add(std::make_unique<Drifting>());
    engine.add(text_stage("reader", {"a"}, {"b"}, "R"));
    engine.run();
    EXPECT_EQ(engine.is_ok(), !verify);
    if (!verify) continue;
    const auto results = by_label(engine);
    EXPECT_EQ(results.at("drifting").code, ExitCode::NotReproducible);
    EXPECT_EQ(results.at("drifting").error,
              "stage drifting made other bytes than before from equal inputs (artifact \"a\")");
    EXPECT_EQ(results.at("reader").status, StageStatus::Skipped);
  }
  EXPECT_THAT(cache.verify(), IsEmpty());
}

TEST(Engine, TwoAtOnceShareOneCache) {
  MemoryStore store;
  std::vector<std::string> results(8);
  std::vector<std::thread> builders;
  for (std::string& result : results)
    builders.emplace_back([&] {
      Cache cache(store);
      result = Diamond().build(cache, 2);
      EXPECT_THAT(cache.take_warnings(), IsEmpty());
    });
  for (std::thread& builder : builders) builder.join();
  EXPECT_THAT(results, ::testing::Each("DBACs"));
  Cache cache(store);
  EXPECT_THAT(cache.verify(), IsEmpty());
}

}  // namespace
}  // namespace skinforge
