#include <algorithm>
#include <cmath>

#include "stages/clip_frames.h"
#include "stages/decoded_images.h"
#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

constexpr double kFramesPerSecond = 24;  // ours: smooth enough to judge a gait
constexpr long kMostFrames = 150;        // ours: a long clip is shown with fewer a second
const StripOptions kView{.width = 320, .height = 320};

/// One clip as an animated picture; all frames through one camera.
class Animated final : public Stage {
 public:
  Animated(ArtifactNames names, ClipRequest request)
      : names_(std::move(names)), request_(std::move(request)) {}

  StageInfo info() const override {
    return {.name = "animated",
            .instance = request_.name,
            .version = 3,
            .reads = {names_.textured(), names_.clip(request_.name)},
            .writes = {names_.animated(request_.name)}};
  }
  void add_to_key(Hasher& key) const override { key.add("name", request_.name); }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto& character = in.get<Character>(names_.textured());
    const Clip& clip = in.get<CompletedClip>(names_.clip(request_.name)).clip;
    const long count = std::clamp(std::lround(clip.duration * kFramesPerSecond), 1L, kMostFrames);
    std::vector<double> times;
    for (long i = 0; i < count; ++i)
      times.push_back(clip.duration * static_cast<double>(i) / static_cast<double>(count));
    const std::vector<Raster> images = decoded_images(character, "result", issues);
    const Subject subject(character.mesh, character.materials, images);
    const auto frames = clip_frames(subject, frames_at(character, clip, times), request_.name, kView);
    out.put(names_.animated(request_.name),
            encode_animated_png(frames, clip.duration / static_cast<double>(count)));
  }

 private:
  ArtifactNames names_;
  ClipRequest request_;
};

}  // namespace

StagePointer make_animated_stage(const ArtifactNames& names, const ClipRequest& request) {
  return std::make_unique<Animated>(names, request);
}

}  // namespace skinforge
