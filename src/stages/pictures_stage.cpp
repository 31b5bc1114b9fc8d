#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "base/safe_name.h"
#include "render/pictures.h"
#include "stages/clip_frames.h"
#include "stages/decoded_images.h"
#include "stages/pictures.h"
#include "stages/site_solids.h"

namespace skinforge {
namespace {

constexpr int kFramesOfStrip = 8;  // ours: a gait is readable in eight

std::string junction_name(std::size_t site) {
  return fmt::format("junction{}", site + 1);
}

// Frames of a strip, and at its end the worst that was found, if anything is wrong there.
std::vector<ClipFrame> frames_of(const Character& character, const Clip& clip, const ClipQuality& quality) {
  std::vector<double> times;
  for (int i = 0; i < kFramesOfStrip; ++i) times.push_back(clip.duration * i / (kFramesOfStrip - 1));
  if (quality.is_faulty()) times.push_back(quality.worst_time);
  std::vector<ClipFrame> frames = frames_at(character, clip, times);
  if (quality.is_faulty()) frames.back().marked = quality.worst_faces;
  return frames;
}

Eigen::AlignedBox3d bounds_of(const PolygonMesh& mesh, std::span<const FaceId> faces) {
  Eigen::AlignedBox3d box;
  for (const FaceId f : faces)
    for (const VertexId v : mesh.face(f)) box.extend(mesh.positions[v.index()]);
  return box;
}

Vec3 place_of(const Graft& graft, std::size_t site) {
  return graft.skeleton[graft.sites[site].fused].joint_from_model.inverse().translation();
}

Vec3 centre_of(const PolygonMesh& mesh, FaceId f) {
  Vec3 sum = Vec3::Zero();
  for (const VertexId v : mesh.face(f)) sum += mesh.positions[v.index()];
  return sum / static_cast<double>(mesh.face(f).size());
}

/// The faces of a site's junction; where several sites have one junction, those nearest to this one's joint.
std::vector<FaceId> junction_faces(const PolygonMesh& mesh, const JoinedSurface& joined, const Graft& graft,
                                   const SiteGroup& group, std::size_t site) {
  const auto is_near = [&](FaceId f) {
    const Vec3 centre = centre_of(mesh, f);
    const double distance = (centre - place_of(graft, site)).norm();
    return std::all_of(group.begin(), group.end(), [&](std::size_t other) {
      return other == site || distance <= (centre - place_of(graft, other)).norm();
    });
  };
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < joined.faces.size(); ++f)
    if (joined.faces[f].site == static_cast<std::int32_t>(group.front()) &&
        (group.size() == 1 || is_near(FaceId(f))))
      faces.push_back(FaceId(f));
  return faces;
}

/// What a person looks at first: rest, junctions, weights, a strip of frames of each clip.
class Pictures final : public Stage {
 public:
  Pictures(ArtifactNames names, const Recipe& recipe, std::span<const ClipRequest> clips)
      : names_(std::move(names)), clips_(clips.begin(), clips.end()), all_(picture_names(recipe, clips)) {}

  StageInfo info() const override {
    StageInfo info{.name = "pictures",
                   .version = 5,
                   .reads = {names_.result(), names_.surface(), names_.graft(), names_.groups()}};
    for (const ClipRequest& clip : clips_) info.reads.push_back(names_.quality(clip.name));
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
    const auto& graft = in.get<Graft>(names_.graft());
    for (const SiteGroup& group : in.get<std::vector<SiteGroup>>(names_.groups()))
      for (const std::size_t site : group) {
        const auto faces = junction_faces(character.mesh, joined, graft, group, site);
        put(junction_name(site), junction_close_up(subject, faces, site));
      }
    const std::vector<std::string> strips = clip_picture_names(clips_);
    for (std::size_t c = 0; c < clips_.size(); ++c)
      put(strips[c], clip_picture(subject,
                                  frames_of(character, character.clips[c],
                                            in.get<ClipQuality>(names_.quality(clips_[c].name))),
                                  clips_[c].name));
  }

 private:
  // A site without a junction shows the whole character.
  static Raster junction_close_up(const Subject& subject, std::span<const FaceId> faces, std::size_t site) {
    if (faces.empty()) return rest_picture(subject);
    const Eigen::AlignedBox3d box = bounds_of(subject.mesh(), faces);
    return junction_picture(
        subject, {faces, box.center(), 0.6 * box.diagonal().norm(), fmt::format("operation {}", site + 1)});
  }

  ArtifactNames names_;
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
