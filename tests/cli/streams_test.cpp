#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "testing/assets.h"
#include "testing/program.h"
#include "testing/temporary_folder.h"

// Goal 16: what programs read is clean, whatever the verb.
namespace skinforge {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::Program;
using testing::ProgramResult;

class Streams : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(testing::repository_file("data/human.glb"), folder / "human.glb");
    std::ofstream(folder / "only.json")
        << R"({"recipe_version": 1, "name": "only", "inputs": {"a": "human.glb"}, "base": "a",
               "animation": {"clips": ["Idle"]}})";
  }
  ProgramResult call(const std::vector<std::string>& arguments) const {
    return Program(SKINFORGE_BINARY, arguments, folder.path()).finish();
  }

  // The words under "Subcommands:".
  std::set<std::string> verbs_of_help() const {
    std::istringstream lines(call({"help"}).out);
    std::set<std::string> verbs;
    bool is_list = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("Subcommands:")) {
        is_list = true;
      } else if (is_list && line.starts_with("  ") && line.size() > 2 && line[2] != ' ') {
        verbs.insert(line.substr(2, line.find(' ', 2) - 2));
      }
    }
    EXPECT_GT(verbs.size(), 15U);
    return verbs;
  }

  testing::TemporaryFolder folder;
};

TEST_F(Streams, Goal16EveryVerbSpeaksJson) {
  const std::vector<std::vector<std::string>> calls = {{"check", "only.json"},
                                                       {"plan", "only.json"},
                                                       {"build", "only.json", "--report", "json"},
                                                       {"plan", "only.json", "--report", "json"},
                                                       {"explain", "only.json", "--report", "json"},
                                                       {"expand", "only.json"},
                                                       {"graph", "only.json"},
                                                       {"stage", "list", "only.json"},
                                                       {"stage", "run", "only.json", "import a"},
                                                       {"report", "only.json", "--report", "json"},
                                                       {"migrate", "only.json"},
                                                       {"bind", "human.glb", "--out", "bound"},
                                                       {"deform", "human.glb", "--frames", "2"},
                                                       {"compare-skinning", "human.glb", "--frames", "2"},
                                                       {"inspect", "human.glb"},
                                                       {"validate", "human.glb"},
                                                       {"repair", "human.glb", "-o", "r.glb"},
                                                       {"diff", "human.glb", "r.glb"},
                                                       {"verify", "out/only/only.glb"},
                                                       {"cache", "stats"},
                                                       {"cache", "verify"},
                                                       {"cache", "path"},
                                                       {"cache", "pin", "only.json"},
                                                       {"cache", "unpin", "only.json"},
                                                       {"cache", "gc", "--max-size", "1"},
                                                       {"doctor"},
                                                       {"schema"},
                                                       {"schema", "event"},
                                                       {"version"},
                                                       {"help"},
                                                       {"help", "status"},
                                                       {"completion", "bash"},
                                                       {"cache", "clear"},
                                                       {"no-such-verb"},
                                                       {"inspect", "nothing.glb"}};
  std::set<std::string> called;
  for (std::vector<std::string> words : calls) {
    const std::string name = words.front() + " " + words.back();
    called.insert(words.front());
    words.emplace_back("--json");
    const ProgramResult result = call(words);
    const json document = json::parse(result.out, nullptr, false);
    EXPECT_FALSE(document.is_discarded()) << name << result.out.substr(0, 200) << result.err;
    for (const std::string& text : {result.out, result.err})
      EXPECT_THAT(text, Not(HasSubstr("\x1b"))) << name;
  }
  for (const std::string& verb : verbs_of_help()) EXPECT_TRUE(called.contains(verb)) << verb;
}

// Each line of the stream is an event of the schema, in order, for stages that run and for those from the
// cache.
TEST_F(Streams, EventsFollowTheirSchema) {
  const json schema_json = json::parse(call({"schema", "event"}).out);
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  std::vector<std::vector<std::string>> seen;
  for (int round = 0; round < 2; ++round) {
    ASSERT_EQ(
        call({"build", "only.json", "missing.json", "-k", "--report", "json", "--events", "events.ndjson"})
            .status,
        6);
    std::ifstream file(folder / "events.ndjson");
    std::vector<std::string> names;
    for (std::string line; std::getline(file, line);) {
      const json event = json::parse(line);
      EXPECT_TRUE(
          valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(event), nullptr))
          << line;
      names.push_back(event.at("event"));
    }
    EXPECT_EQ(names.front(), "build-started");
    EXPECT_EQ(names.back(), "build-finished");
    EXPECT_EQ(std::count(names.begin(), names.end(), "recipe-finished"), 2);
    seen.push_back(names);
  }
  EXPECT_GT(std::count(seen[0].begin(), seen[0].end(), "stage-started"), 5);
  EXPECT_EQ(std::count(seen[1].begin(), seen[1].end(), "stage-started"), 0);
  EXPECT_EQ(std::count(seen[0].begin(), seen[0].end(), "stage-finished"),
            std::count(seen[1].begin(), seen[1].end(), "stage-finished"));
}

TEST_F(Streams, SchemaOfEventsIsTheFileOfTheRepository) {
  std::ifstream file(testing::repository_file("schemas/event.schema.json"));
  EXPECT_EQ(call({"schema", "event"}).out, std::string(std::istreambuf_iterator<char>(file), {}));
}

// Bash takes the script, and completes verbs, choices and options by it.
TEST_F(Streams, BashCompletes) {
  const auto offered = [&](const std::string& words, int count) {
    const std::string script = "source <(\"$1\" completion bash); COMP_WORDS=(" + words +
                               "); COMP_CWORD=" + std::to_string(count) +
                               "; _skinforge; echo \"${COMPREPLY[*]}\"";
    const auto result =
        Program("/bin/bash", {"-c", script, "bash", SKINFORGE_BINARY}, folder.path()).finish();
    EXPECT_THAT(result.err, IsEmpty());
    return result.out;
  };
  EXPECT_THAT(offered("skinforge val", 1), HasSubstr("validate"));
  EXPECT_EQ(offered("skinforge build --report js", 3), "json\n");
  EXPECT_THAT(offered("skinforge cache g", 2), HasSubstr("gc"));
  EXPECT_THAT(offered("skinforge build --keep", 2), HasSubstr("--keep-going"));
}

TEST_F(Streams, CacheStatsCountHitsAndSavedTime) {
  for (int round = 0; round < 2; ++round) call({"build", "only.json", "--report", "json"});
  const json usage = json::parse(call({"cache", "stats", "--json"}).out).at("usage");
  EXPECT_EQ(usage.at("builds"), 2);
  EXPECT_EQ(usage.at("hits"), usage.at("runs"));
  EXPECT_DOUBLE_EQ(usage.at("hit_rate"), 0.5);
  EXPECT_EQ(usage.at("saved_seconds"), usage.at("spent_seconds"));  // what the first one did
}

TEST_F(Streams, GraphNamesStagesAndWhatTheyNeed) {
  call({"build", "only.json", "--report", "json"});
  const json graph = json::parse(call({"graph", "only.json", "--report", "json", "--json"}).out);
  const auto has_edge = [&](const char* from, const char* to) {
    for (const json& edge : graph.at("edges"))
      if (edge.at("from") == from && edge.at("to") == to) return true;
    return false;
  };
  EXPECT_TRUE(has_edge("import a", "pose a")) << graph.at("edges");
  EXPECT_TRUE(has_edge("export", "validate"));
  EXPECT_THAT(call({"graph", "only.json"}).out, HasSubstr("\"export\" -> \"validate\";"));
}

TEST_F(Streams, DoctorFindsWhatIsNeeded) {
  const json report = json::parse(call({"doctor", "--json"}).out);
  EXPECT_EQ(report.at("exit_code"), 0) << report;
  EXPECT_GE(report.at("checks").size(), 5U);
}

}  // namespace
}  // namespace skinforge
