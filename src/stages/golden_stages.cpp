#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "base/text.h"
#include "diff/diff_text.h"
#include "stages/compared_pictures.h"
#include "stages/expect_stage.h"
#include "stages/file_facts.h"
#include "stages/golden_comparison.h"

namespace skinforge {
namespace {

DiffThresholds thresholds_of(const GoldenOptions& golden) {
  return {.geometry = golden.geometry,
          .normals = golden.normals,
          .uv = golden.uv,
          .weights = golden.weights,
          .animation = golden.animation,
          .duration = golden.duration,
          .picture = golden.picture,
          .structure = golden.structure};
}

// A GLB in hand as a character. What is odd about it was said where it was made.
struct Side {
  Character character;
  FileFacts facts;
};

Side side_of(const StageInput& in, const std::string& artifact, const std::string& name) {
  const std::vector<InputFile> files{{name, in.get<Bytes>(artifact), in.digest(artifact)}};
  IssueSink known;
  return {build_character(read_scene(files), name, known), facts_of(files)};
}

class Compare final : public Stage {
 public:
  Compare(ArtifactNames names, GoldenOptions golden) : names_(std::move(names)), golden_(std::move(golden)) {}

  StageInfo info() const override {
    return {.name = "compare",
            .version = 3,
            .reads = {names_.glb(), names_.golden()},
            .writes = {names_.comparison()}};
  }
  void add_to_key(Hasher& key) const override { key.add_value("golden", golden_); }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    GoldenComparison comparison;
    comparison.is_missing = in.get<Bytes>(names_.golden()).empty();
    if (!comparison.is_missing) {
      const Side a = side_of(in, names_.golden(), "golden.glb"), b = side_of(in, names_.glb(), "output.glb");
      CharacterDiff diff = compare_characters(a.character, b.character, {.a = a.facts, .b = b.facts});
      add_pictures(a.character, b.character, diff);
      comparison.findings = judge(diff, thresholds_of(golden_));
      comparison.text = to_text(diff, comparison.findings);
    }
    for (const DiffFinding& f : comparison.findings)
      if (f.is_over)
        issues.warn("golden-different", "golden",
                    fmt::format("unlike the golden in {}, {}: {}", f.group, f.name, f.text));
    out.put(names_.comparison(), std::move(comparison));
  }

 private:
  ArtifactNames names_;
  GoldenOptions golden_;
};

class Golden final : public Stage {
 public:
  Golden(ArtifactNames names, const GoldenOptions& golden)
      : names_(std::move(names)), file_(printable(golden.file.text)) {}

  StageInfo info() const override {
    return {.name = "golden",
            .version = 1,
            .reads = {names_.comparison(), names_.golden()},
            .writes = {names_.prefix + "golden_verdict"}};
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto& comparison = in.get<GoldenComparison>(names_.comparison());
    if (comparison.is_missing)
      throw Error(
          ExitCode::BadInput,
          fmt::format("{} is not there; look at what was built, then build --accept makes it", file_));
    const auto& findings = comparison.findings;
    const auto first =
        std::find_if(findings.begin(), findings.end(), [](const auto& f) { return f.is_over; });
    if (first != findings.end())
      throw Error(ExitCode::Different,
                  fmt::format("differs from {}: {}; build --accept takes it as it is now", file_,
                              faults_of(findings)));
    out.put(names_.prefix + "golden_verdict", std::string("as the golden"));
  }

 private:
  // The first fault, and how many more.
  static std::string faults_of(const std::vector<DiffFinding>& findings) {
    std::string text;
    std::size_t others = 0;
    for (const DiffFinding& f : findings) {
      if (!f.is_over) continue;
      if (text.empty())
        text = fmt::format("{}, {}: {}", f.group, f.name, f.text);
      else
        ++others;
    }
    return others == 0 ? text : fmt::format("{}; and {} more", text, others);
  }

  ArtifactNames names_;
  std::string file_;  // leads messages only
};

}  // namespace

StagePointer make_compare_stage(const ArtifactNames& names, const GoldenOptions& golden) {
  return std::make_unique<Compare>(names, golden);
}

StagePointer make_golden_stage(const ArtifactNames& names, const GoldenOptions& golden) {
  return std::make_unique<Golden>(names, golden);
}

bool is_verdict(const StageInfo& stage) {
  return stage.name == "expect" || stage.name == "golden";
}

bool is_of_report(const StageInfo& stage) {
  static const std::set<std::string_view> kNames = {"quality", "animated", "compare",
                                                    "report",  "pictures", "view"};
  return is_verdict(stage) || kNames.contains(stage.name);
}

}  // namespace skinforge
