#include "pipeline/engine_session.h"

#include "base/expect.h"
#include "pipeline/stopwatch.h"
#include "pipeline/work_share.h"

namespace skinforge {

void Engine::Session::add_source(const std::string& name, std::shared_ptr<Artifact> artifact) {
  if (!slots.emplace(name, Slot{std::move(artifact), nullptr}).second)
    throw Error(ExitCode::Internal, "artifact \"" + name + "\" has two makers");
}

void Engine::Session::add(std::unique_ptr<Stage> stage) {
  auto node = std::make_unique<Node>();
  node->info = stage->info();
  node->stage = std::move(stage);
  SF_EXPECT(!node->info.writes.empty());
  node->info.writes.push_back(issues_artifact(node->info.writes.front()));
  for (const std::string& name : node->info.writes)
    if (!slots.emplace(name, Slot{nullptr, node.get()}).second)
      throw Error(ExitCode::Internal, "artifact \"" + name + "\" has two makers");
  nodes.push_back(std::move(node));
}

const Engine::Slot& Engine::Session::slot(const std::string& name) const {
  const auto found = slots.find(name);
  if (found == slots.end()) throw Error(ExitCode::Internal, "nobody makes artifact \"" + name + "\"");
  return found->second;
}

std::shared_ptr<Artifact> Engine::Session::artifact(const std::string& name) const {
  const std::lock_guard lock(mutex);
  return slot(name).artifact;
}

Artifact::Loader Engine::Session::loader(const Digest& digest) {
  return [this, digest] { return cache.blob(digest); };
}

void Engine::Session::compute_key(Node& node) const {
  std::vector<Digest> inputs;
  for (const std::string& name : node.info.reads) inputs.push_back(artifact(name)->digest());
  node.key = stage_key(*node.stage, node.info, options.build, inputs);
}

// Takes the outputs of an earlier run; they are loaded when somebody asks.
void Engine::Session::adopt(Node& node, const Manifest& manifest) {
  SF_EXPECT(manifest.outputs.size() == node.info.writes.size());
  const std::lock_guard lock(mutex);
  for (std::size_t i = 0; i < manifest.outputs.size(); ++i) {
    const Manifest::Output& output = manifest.outputs[i];
    slots.at(node.info.writes[i]).artifact =
        std::make_shared<Artifact>(output.digest, output.size, loader(output.digest));
  }
  node.result.status = StageStatus::Hit;
  node.result.issues = manifest.issues;
  node.result.cost = manifest.cost;
}

// The last run of this session as it was before the session began.
const RunRecord& Engine::Session::earlier_run() {
  const std::lock_guard lock(recording);
  if (!last_run) last_run = run_now = cache.last_run(options.session);
  return *last_run;
}

std::vector<KeyChange> Engine::Session::changes(const Node& node, const RunRecord& since) {
  const std::string label = node.info.label();
  EarlierRun earlier;
  if (const auto stage = since.stages.find(label); stage != since.stages.end()) {
    earlier.key = stage->second.key;
    earlier.settings = since.settings_of(label);
    if (*earlier.key != node.key.digest) earlier.manifest = cache.peek(*earlier.key);
  }
  return key_changes(node.info, node.key, options.settings, earlier, options.reads_setting);
}

// Why a stage that is not in the cache has to run.
std::string Engine::Session::reason(const Node& node) {
  if (options.session.empty()) return "not in the cache";
  const std::vector<KeyChange> found = changes(node, earlier_run());
  return found.empty() ? to_text({KeyChange::Kind::EntryLost}) : why_run(found);
}

std::vector<std::shared_ptr<Artifact>> Engine::Session::execute(Node& node, IssueSink& issues,
                                                                StageCost& cost) {
  StageInput::Artifacts inputs;
  for (const std::string& name : node.info.reads) {
    ensure(name);
    inputs[name] = artifact(name);
  }
  const StageInput in(std::move(inputs));
  StageOutput out(node.info);
  std::optional<WorkShare::Held> turn;
  if (options.share) turn.emplace(options.share->take_turn());
  const Stopwatch watch(options.jobs == 1);
  node.stage->run(in, out, issues);
  cost = watch.cost();
  out.put(node.info.writes.back(), issues.issues());
  return out.take();
}

// Makes fresh outputs known. Two stages with one key (a file used under two names) must give the same bytes;
// if not, something that changes the result is missing from the key, and whichever manifest is stored last
// would answer for both.
void Engine::Session::accept(const Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs) {
  const std::lock_guard lock(mutex);
  const Node& twin = *ran.emplace(node.key.digest, &node).first->second;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& other = slots.at(twin.info.writes[i]).artifact;
    if (other && other->digest() != outputs[i]->digest())
      throw Error(ExitCode::NotReproducible,
                  "gave other bytes than " + twin.info.label() + ", which has the same key (artifact \"" +
                      node.info.writes[i] + "\"): a parameter is missing from add_to_key");
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) slots.at(node.info.writes[i]).artifact = outputs[i];
}

// Blobs first, the manifest that names them last; when the cache refuses, the bytes stay in memory.
void Engine::Session::store(Node& node, const std::vector<std::shared_ptr<Artifact>>& outputs) {
  Manifest manifest{.key = node.key.digest,
                    .build = node.key.build,
                    .stage = node.info.name,
                    .instance = node.info.instance,
                    .version = node.info.version,
                    .parameters = node.key.parameters,
                    .inputs = node.key.inputs,
                    .outputs = {},
                    .issues = node.result.issues,
                    .cost = node.result.cost};
  bool is_stored = true;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Digest& digest = outputs[i]->digest();
    manifest.outputs.push_back({node.info.writes[i], digest, outputs[i]->size()});
    if (cache.has_blob(digest, outputs[i]->size()) || cache.put_blob(digest, *outputs[i]->bytes()))
      outputs[i]->stored(loader(digest));
    else
      is_stored = false;
  }
  if (is_stored) cache.put(manifest);
}

// After this the artifact can be read: a lost or damaged result is made again by its stage.
void Engine::Session::ensure(const std::string& name) {
  if (artifact(name)->try_load()) return;
  Node* maker = slot(name).maker;
  SF_EXPECT(maker != nullptr);  // the loader of a source throws
  remake(*maker, name);
}

void Engine::Session::remake(Node& node, const std::string& wanted) {
  const std::lock_guard alone(node.remaking);
  if (artifact(wanted)->try_load()) return;  // somebody else did
  IssueSink issues;
  StageCost cost;
  const auto outputs = execute(node, issues, cost);
  expect_same(node, outputs);
  for (std::size_t i = 0; i < outputs.size(); ++i)
    artifact(node.info.writes[i])->restore(*outputs[i]->bytes());
  {
    const std::lock_guard lock(mutex);
    node.result.status = StageStatus::Ran;
    node.result.reason = "its result in the cache was missing or damaged";
    node.result.cost = cost;
  }
  store(node, outputs);
}

void Engine::Session::expect_same(const Node& node,
                                  const std::vector<std::shared_ptr<Artifact>>& outputs) const {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (outputs[i]->digest() != artifact(node.info.writes[i])->digest())
      throw Error(ExitCode::NotReproducible,
                  "stage " + node.info.label() +
                      " made other bytes than before from equal inputs (artifact \"" + node.info.writes[i] +
                      "\")");
}

void Engine::Session::tell_start(const Node& node) {
  if (!options.observer) return;
  const std::lock_guard lock(observing);
  options.observer->on_start(node.info);
}

// Runs a stage whose outputs were just taken from the cache. The entry stays whatever comes out: which of the
// two is right nobody knows.
void Engine::Session::compare(Node& node) {
  call_helpers();
  node.result.reason = "run again to compare";
  tell_start(node);
  IssueSink issues;
  const auto outputs = execute(node, issues, node.result.cost);
  expect_same(node, outputs);
  node.result.status = StageStatus::Ran;
}

// Whether the cache has the results of the key.
bool Engine::Session::take_known(Node& node) {
  const auto manifest = cache.find(node.key.digest);
  if (manifest) adopt(node, *manifest);
  return manifest.has_value();
}

void Engine::Session::process(Node& node) {
  if (const Node* failed = failed_maker(node)) {
    node.result.status = StageStatus::Skipped;
    node.result.reason =
        failed->info.label() + (failed->result.status == StageStatus::Failed ? " failed" : " was skipped");
    return;
  }
  compute_key(node);
  node.result.key = node.key.digest;
  if (take_known(node)) {
    if (options.verify) compare(node);
    return;
  }
  call_helpers();
  std::optional<WorkShare::Held> claim;
  if (options.share) {
    claim.emplace(options.share->claim(node.key.digest));
    if (take_known(node)) return;  // made meanwhile
  }

  if (const auto failure = remembered_failure(node)) {
    node.result.is_remembered = true;
    throw Error(failure->code, failure->message);
  }
  node.result.reason = reason(node);
  tell_start(node);
  IssueSink issues;
  const auto outputs = execute(node, issues, node.result.cost);
  node.result.issues = issues.issues();
  node.result.status = StageStatus::Ran;
  accept(node, outputs);
  store(node, outputs);
}

// The failure of an earlier run that this one would meet again.
std::optional<StoredFailure> Engine::Session::remembered_failure(const Node& node) {
  if (options.retry_failed || !options.remembers_failure) return std::nullopt;
  return cache.failure(node.key.digest);
}

// A stage that ran well or badly: its failure is stored or forgotten.
void Engine::Session::remember_failure(const Node& node) {
  const StageResult& result = node.result;
  if (!options.remembers_failure || result.is_remembered) return;
  if (result.status == StageStatus::Ran && options.retry_failed) cache.forget_failure(node.key.digest);
  if (result.status == StageStatus::Failed && options.remembers_failure(node.info, result.code))
    cache.put_failure(node.key.digest, {result.code, result.error});
}

void Engine::Session::process_safely(Node& node) {
  const auto fail = [&](ExitCode code, const std::string& message) {
    node.result.status = StageStatus::Failed;
    node.result.code = code;
    node.result.error = message;
  };
  try {
    process(node);
    remember_failure(node);
  } catch (const Error& error) {
    fail(error.code(), error.what());
    remember_failure(node);
  } catch (const std::bad_alloc&) {
    fail(ExitCode::StageFailed, "not enough memory");
  } catch (const std::exception& error) {
    fail(ExitCode::Internal, error.what());
  }
  finish(node);
}

void Engine::Session::finish(Node& node) {
  {
    const std::lock_guard lock(mutex);
    node.result.info = node.info;
    node.is_done = true;
  }
  if (!options.observer) return;
  const std::lock_guard lock(observing);
  options.observer->on_finish(node.result);
}

// The first maker of an input that failed or was skipped.
const Engine::Node* Engine::Session::failed_maker(const Node& node) const {
  const std::lock_guard lock(mutex);
  for (const std::string& name : node.info.reads) {
    const Node* maker = slot(name).maker;
    if (!maker || !maker->is_done) continue;
    if (maker->result.status == StageStatus::Failed || maker->result.status == StageStatus::Skipped)
      return maker;
  }
  return nullptr;
}

}  // namespace skinforge
