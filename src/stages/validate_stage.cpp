#include <fmt/format.h>

#include "io/import.h"
#include "stages/stages.h"
#include "stages/validation.h"

namespace skinforge {
namespace {

/// Reads the written file back as any engine would and compares it with what was meant. What differs fails
/// the build with exit 4.
class Validate final : public Stage {
 public:
  explicit Validate(ArtifactNames names) : names_(std::move(names)) {}

  StageInfo info() const override {
    return {.name = "validate",
            .version = 1,
            .reads = {names_.glb(), names_.result()},
            .writes = {names_.validation()}};
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const InputFile file{"output.glb", in.get<Bytes>(names_.glb()), in.digest(names_.glb())};
    IssueSink repairs;
    const Character read = build_character(read_scene({file}), "output.glb", repairs);
    Validation validation = compare_with_written(in.get<Character>(names_.result()), read);
    for (const Issue& issue : repairs.issues())
      if (issue.severity == Severity::Warning)
        validation.faults.push_back(fmt::format("{}: {}", issue.code, issue.message));
    if (!validation.faults.empty())
      throw Error(ExitCode::Invalid,
                  fmt::format("the written GLB is not what was meant: {}", validation.faults.front()));
    out.put(names_.validation(), std::move(validation));
  }

 private:
  ArtifactNames names_;
};

}  // namespace

StagePointer make_validate_stage(const ArtifactNames& names) {
  return std::make_unique<Validate>(names);
}

}  // namespace skinforge
