#include <fmt/format.h>

#include <set>

#include "io/build_character_oddities.h"
#include "io/import.h"
#include "stages/inputs.h"
#include "stages/stages.h"
#include "stages/validation.h"

namespace skinforge {
namespace {

/// Reads the written file back as any engine would and compares it with what was meant. What differs fails
/// the build with exit 4.
class Validate final : public Stage {
 public:
  Validate(ArtifactNames names, std::vector<std::string> inputs)
      : names_(std::move(names)), inputs_(std::move(inputs)) {}

  StageInfo info() const override {
    StageInfo info{.name = "validate",
                   .version = 2,
                   .reads = {names_.glb(), names_.result()},
                   .writes = {names_.validation()}};
    for (const std::string& input : inputs_) info.reads.push_back(issues_artifact(names_.imported(input)));
    return info;
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const InputFile file{"output.glb", in.get<Bytes>(names_.glb()), in.digest(names_.glb())};
    IssueSink repairs;
    const Character read = build_character(read_scene({file}), "output.glb", repairs);
    Validation validation = compare_with_written(in.get<Character>(names_.result()), read);
    const std::set<std::string> known = oddities_of_inputs(in);
    for (const Issue& issue : repairs.issues())
      if (issue.severity == Severity::Warning && !known.contains(issue.code))
        validation.faults.push_back(fmt::format("{}: {}", issue.code, issue.message));
    if (!validation.faults.empty())
      throw Error(ExitCode::Invalid,
                  fmt::format("the written GLB is not what was meant: {}", validation.faults.front()));
    out.put(names_.validation(), std::move(validation));
  }

 private:
  // What an input has and was told of (doubled faces, joints at one place) goes over into the result. What
  // was repaired there does not: found again, it is ours.
  std::set<std::string> oddities_of_inputs(const StageInput& in) const {
    std::set<std::string> codes;
    for (const std::string& input : inputs_)
      for (const Issue& issue : in.get<std::vector<Issue>>(issues_artifact(names_.imported(input))))
        if (is_oddity(issue.code)) codes.insert(issue.code);
    return codes;
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
};

}  // namespace

StagePointer make_validate_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<Validate>(names, input_names(recipe));
}

}  // namespace skinforge
