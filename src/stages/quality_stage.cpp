#include <tuple>

#include "animation/feet.h"
#include "animation/sampling.h"
#include "geometry/posed_faults.h"
#include "skinning/linear_blend.h"
#include "stages/inputs.h"
#include "stages/stages.h"

namespace skinforge {
namespace {

constexpr int kLookedAt = 6;  // ours: frames of a clip, in the middles of as many equal stretches

// Triangles of the result as `PosedSurface` wants them.
struct Triangles {
  std::vector<TriangleCornerIds> corners;
  std::vector<std::int32_t> parts;
  std::vector<FaceId> faces;

  explicit Triangles(const JoinedSurface& joined) {
    const Triangulation triangulation = triangulate(joined.mesh);
    for (std::size_t t = 0; t < triangulation.triangles.size(); ++t) {
      const auto& [a, b, c] = triangulation.triangles[t];
      const FaceId face = triangulation.face[t];
      corners.push_back({a.value, b.value, c.value});
      parts.push_back(joined.faces[face.index()].source.value);
      faces.push_back(face);
    }
  }
};

/// What one clip does to the surface and to the feet.
class Quality final : public Stage {
 public:
  Quality(ArtifactNames names, std::size_t source_count, ClipRequest request)
      : names_(std::move(names)), source_count_(source_count), request_(std::move(request)) {}

  StageInfo info() const override {
    StageInfo info{.name = "quality",
                   .instance = request_.name,
                   .version = 1,
                   .reads = {names_.bound(), names_.surface(), names_.graft(), names_.clip(request_.name)},
                   .writes = {names_.quality(request_.name)}};
    for (std::size_t s = 0; s < source_count_; ++s) info.reads.push_back(names_.motion(s));
    return info;
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto& character = in.get<Character>(names_.bound());
    const auto& joined = in.get<SurfaceResult>(names_.surface()).joined;
    const Clip& clip = in.get<CompletedClip>(names_.clip(request_.name)).clip;
    const Triangles triangles(joined);
    const PosedSurface surface(character.mesh.positions, triangles.corners, triangles.parts);
    ClipQuality quality;
    for (int i = 0; i < kLookedAt; ++i) {
      const double time = clip.duration * (i + 0.5) / kLookedAt;
      const Pose pose = sample(character.skeleton, clip, time);
      add_frame(time,
                surface.measure(linear_blend(character.mesh.positions, character.weights,
                                             skinning_palette(character.skeleton, pose))),
                triangles.faces, quality);
    }
    add_feet(in, clip, quality);
    out.put(names_.quality(request_.name), std::move(quality));
  }

 private:
  static void add_frame(double time, const PosedFaults& faults, const std::vector<FaceId>& faces,
                        ClipQuality& quality) {
    quality.times.push_back(time);
    const auto worst = std::tuple(quality.intersections, quality.folds, quality.stretch);
    if (std::tuple(std::uint64_t{faults.intersections}, std::uint64_t{faults.folds}, faults.stretch) <= worst)
      return;
    quality.intersections = faults.intersections;
    quality.folds = faults.folds;
    quality.stretch = faults.stretch;
    quality.worst_time = time;
    quality.worst_faces.clear();
    for (const std::int32_t t : faults.triangles) quality.worst_faces.push_back(faces[t]);
  }

  void add_feet(const StageInput& in, const Clip& clip, ClipQuality& quality) const {
    std::vector<const MotionSet*> motions;
    for (std::size_t s = 0; s < source_count_; ++s) motions.push_back(&in.get<MotionSet>(names_.motion(s)));
    const FootFaults feet = foot_faults(in.get<Graft>(names_.graft()), motions, clip);
    quality.foot_sink = feet.sink;
    quality.foot_slide = feet.slide;
  }

  ArtifactNames names_;
  std::size_t source_count_;
  ClipRequest request_;
};

}  // namespace

StagePointer make_quality_stage(const ArtifactNames& names, std::size_t source_count,
                                const ClipRequest& request) {
  return std::make_unique<Quality>(names, source_count, request);
}

}  // namespace skinforge
