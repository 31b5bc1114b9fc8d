#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

/// All clips of one source as candidates for completion (Sec. 8.1).
class Motion final : public Stage {
 public:
  Motion(ArtifactNames names, std::size_t source, std::string input)
      : names_(std::move(names)), source_(source), input_(std::move(input)) {}

  StageInfo info() const override {
    return {.name = "motion",
            .instance = std::to_string(source_),
            .version = 4,
            .reads = {names_.character(input_), names_.graft(), names_.joint_maps()},
            .writes = {names_.motion(source_)}};
  }
  void add_to_key(Hasher& key) const override { key.add_value("source", source_); }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto& maps = in.get<std::vector<JointMap>>(names_.joint_maps());
    out.put(names_.motion(source_),
            build_motion_set(in.get<Character>(names_.character(input_)), in.get<Graft>(names_.graft()),
                             SourceId(source_), maps[source_]));
  }

 private:
  ArtifactNames names_;
  std::size_t source_;
  std::string input_;
};

/// One clip of one input on the whole new body (Sec. 8).
class CompleteClip final : public Stage {
 public:
  CompleteClip(ArtifactNames names, const Recipe& recipe, std::size_t source_count, ClipRequest request)
      : names_(std::move(names)),
        inputs_(input_names(recipe)),
        source_count_(source_count),
        request_(std::move(request)) {}

  StageInfo info() const override {
    StageInfo info{.name = "complete_clip",
                   .instance = request_.name,
                   .version = 4,
                   .reads = joined(character_names(names_, inputs_), {names_.graft()}),
                   .writes = {names_.clip(request_.name)}};
    for (std::size_t s = 0; s < source_count_; ++s) info.reads.push_back(names_.motion(s));
    return info;
  }
  void add_to_key(Hasher& key) const override {
    key.add("name", request_.name);
    key.add_value("input", request_.input);
    key.add_value("clip", request_.clip);
    key.add_value("options", request_.options);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    std::vector<const MotionSet*> motions;
    for (std::size_t s = 0; s < source_count_; ++s) motions.push_back(&in.get<MotionSet>(names_.motion(s)));
    out.put(names_.clip(request_.name),
            complete_clip(get_characters(in, names_, inputs_), in.get<Graft>(names_.graft()), motions,
                          request_.input, request_.clip, request_.name, request_.options));
  }

 private:
  ArtifactNames names_;
  std::vector<std::string> inputs_;
  std::size_t source_count_;
  ClipRequest request_;
};

}  // namespace

StagePointer make_motion_stage(const ArtifactNames& names, std::size_t source, const std::string& input) {
  return std::make_unique<Motion>(names, source, input);
}

StagePointer make_complete_clip_stage(const ArtifactNames& names, const Recipe& recipe,
                                      std::size_t source_count, const ClipRequest& request) {
  return std::make_unique<CompleteClip>(names, recipe, source_count, request);
}

}  // namespace skinforge
