#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "animation/sampling.h"
#include "base/safe_name.h"
#include "render/pictures.h"
#include "skeleton/pose.h"
#include "skinning/linear_blend.h"
#include "stages/decoded_images.h"
#include "stages/pictures.h"

namespace skinforge {
namespace {

constexpr int kFramesOfStrip = 8;  // ours: a gait is readable in eight

std::string junction_name(std::size_t site) {
  return fmt::format("junction{}", site + 1);
}

std::vector<ClipFrame> frames_of(const Character& character, const Clip& clip) {
  std::vector<ClipFrame> frames;
  for (int i = 0; i < kFramesOfStrip; ++i) {
    const double time = clip.duration * i / (kFramesOfStrip - 1);
    const Pose pose = sample(character.skeleton, clip, time);
    frames.push_back({time, linear_blend(character.mesh.positions, character.weights,
                                         skinning_palette(character.skeleton, pose))});
  }
  return frames;
}

Eigen::AlignedBox3d bounds_of(const PolygonMesh& mesh, std::span<const FaceId> faces) {
  Eigen::AlignedBox3d box;
  for (const FaceId f : faces)
    for (const VertexId v : mesh.face(f)) box.extend(mesh.positions[v.index()]);
  return box;
}

/// What a person looks at first: rest, junctions, weights, a strip of frames of each clip.
class Pictures final : public Stage {
 public:
  Pictures(ArtifactNames names, const Recipe& recipe, std::span<const ClipRequest> clips)
      : names_(std::move(names)),
        site_count_(recipe.operations.size()),
        clips_(clips.begin(), clips.end()),
        all_(picture_names(recipe, clips)) {}

  StageInfo info() const override {
    StageInfo info{.name = "pictures", .version = 1, .reads = {names_.result(), names_.surface()}};
    for (const std::string& name : all_) info.writes.push_back(names_.picture(name));
    return info;
  }
  void add_to_key(Hasher& key) const override { key.add_value("names", all_); }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    const auto& character = in.get<Character>(names_.result());
    const auto& joined = in.get<SurfaceResult>(names_.surface()).joined;
    const std::vector<Raster> images = decoded_images(character, "result", issues);
    const Subject subject(character.mesh, character.materials, images);
    const auto put = [&](const std::string& name, const Raster& raster) {
      out.put(names_.picture(name), encode_png(raster));
    };
    put("rest", rest_picture(subject));
    put("weights", weights_picture(subject, character.weights, character.skeleton.size()));
    for (std::size_t k = 0; k < site_count_; ++k)
      put(junction_name(k), junction_close_up(subject, joined, k));
    const std::vector<std::string> strips = clip_picture_names(clips_);
    for (std::size_t c = 0; c < clips_.size(); ++c)
      put(strips[c], clip_picture(subject, frames_of(character, character.clips[c]), clips_[c].name));
  }

 private:
  // A site without a junction of its own shows the whole character.
  static Raster junction_close_up(const Subject& subject, const JoinedSurface& joined, std::size_t site) {
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < joined.faces.size(); ++f)
      if (joined.faces[f].site == static_cast<std::int32_t>(site)) faces.push_back(FaceId(f));
    if (faces.empty()) return rest_picture(subject);
    const Eigen::AlignedBox3d box = bounds_of(subject.mesh(), faces);
    return junction_picture(
        subject, {faces, box.center(), 0.6 * box.diagonal().norm(), fmt::format("operation {}", site + 1)});
  }

  ArtifactNames names_;
  std::size_t site_count_;
  std::vector<ClipRequest> clips_;
  std::vector<std::string> all_;
};

}  // namespace

std::vector<std::string> clip_picture_names(std::span<const ClipRequest> clips) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const ClipRequest& clip : clips) {
    const std::string base = "clip_" + safe_file_name(clip.name);
    std::string name = base;
    for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}_{}", base, n);
    names.push_back(name);
  }
  return names;
}

std::vector<std::string> picture_names(const Recipe& recipe, std::span<const ClipRequest> clips) {
  std::vector<std::string> names{"rest", "weights"};
  for (std::size_t k = 0; k < recipe.operations.size(); ++k) names.push_back(junction_name(k));
  for (std::string& strip : clip_picture_names(clips)) names.push_back(std::move(strip));
  return names;
}

StagePointer make_pictures_stage(const ArtifactNames& names, const Recipe& recipe,
                                 std::span<const ClipRequest> clips) {
  return std::make_unique<Pictures>(names, recipe, clips);
}

}  // namespace skinforge
