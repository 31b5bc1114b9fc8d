#include "diff/picture_diff.h"

#include <algorithm>

#include "animation/morphing.h"
#include "animation/sampling.h"
#include "base/archive.h"
#include "base/parallel.h"
#include "render/draw.h"
#include "skinning/linear_blend.h"

namespace skinforge {

namespace {
constexpr int kSize = 256;           // ours: pixels; a body covers some 15,000 of them
constexpr std::size_t kClips = 3;    // ours: the worst, and two more
constexpr std::size_t kOfWorst = 3;  // cameras of the worst clip, the first of kCameras
constexpr std::size_t kThreeQuarter = 2;

struct Camera {
  const char* name;
  ViewAngles angles;
};
const Camera kCameras[] = {{"front", {0, radians(6)}},
                           {"side", {radians(90), radians(6)}},
                           {"three-quarter", {radians(35), radians(14)}},
                           {"back", {radians(215), radians(16)}}};

// A character in one moment.
struct Moment {
  std::vector<Vec3> positions, normals;

  explicit Moment(const Character& c) : positions(c.mesh.positions), normals(c.mesh.normals) {}
  Moment(const Character& c, const std::string& clip_name, double time) {
    const Clip& clip = *std::find_if(c.clips.begin(), c.clips.end(),
                                     [&](const Clip& each) { return each.name == clip_name; });
    const auto palette = skinning_palette(c.skeleton, sample(c.skeleton, clip, time));
    positions = linear_blend(morphed_positions(c, clip, time), c.weights, palette);
    normals = linear_blend_normals(c.mesh.normals, c.mesh.corners, c.weights, palette);
  }
  bool operator==(const Moment&) const = default;
};

struct Scene {
  std::string clip;  // empty: the bind pose
  double time = 0;
  std::vector<std::size_t> cameras;
};

std::vector<Scene> scenes_of(const std::vector<ClipDiff>& clips) {
  std::vector<Scene> scenes = {{"", 0, {0, 1, 2, 3}}};
  std::vector<const ClipDiff*> worst_first;
  for (const ClipDiff& clip : clips) worst_first.push_back(&clip);
  std::stable_sort(worst_first.begin(), worst_first.end(),
                   [](const ClipDiff* x, const ClipDiff* y) { return x->max > y->max; });
  worst_first.resize(std::min(worst_first.size(), kClips));
  for (const ClipDiff* clip : worst_first) {
    Scene& scene = scenes.emplace_back();
    scene.clip = clip->clip;
    scene.time = clip->max > 0 ? clip->time : clip->duration_a / 2;
    if (clip != worst_first.front())
      scene.cameras = {kThreeQuarter};
    else
      for (std::size_t camera = 0; camera < kOfWorst; ++camera) scene.cameras.push_back(camera);
  }
  return scenes;
}

template <class Value>
bool same_bytes(const Value& a, const Value& b) {
  return to_bytes(a) == to_bytes(b);
}

Raster drawn(const Subject& subject, const Moment& moment, const View& view) {
  return draw(subject, {.positions = moment.positions, .normals = moment.normals}, view,
              {.width = kSize, .height = kSize, .alpha_is_coverage = true});
}
}  // namespace

bool draw_alike(const Character& a, const Character& b) {
  return same_bytes(a.mesh, b.mesh) && same_bytes(a.weights, b.weights) &&
         same_bytes(a.skeleton, b.skeleton) && same_bytes(a.clips, b.clips) &&
         same_bytes(a.materials, b.materials) && same_bytes(a.images, b.images) &&
         same_bytes(a.morphs, b.morphs);
}

std::vector<PictureDiff> compare_pictures(const DrawnCharacter& a, const DrawnCharacter& b,
                                          const CharacterDiff& diff, bool keeps_pictures) {
  if (a.character.mesh.face_count() + b.character.mesh.face_count() == 0) return {};
  const bool have_same_skin = same_bytes(a.character.mesh, b.character.mesh) &&
                              same_bytes(a.character.materials, b.character.materials) &&
                              same_bytes(a.character.images, b.character.images);
  const Subject of_a(a.character.mesh, a.character.materials, a.images),
      of_b(b.character.mesh, b.character.materials, b.images);
  std::vector<PictureDiff> pictures;
  for (const Scene& scene : scenes_of(diff.clips)) {
    const auto moment_of = [&](const Character& c) {
      return scene.clip.empty() ? Moment(c) : Moment(c, scene.clip, scene.time);
    };
    const Moment at_a = moment_of(a.character), at_b = moment_of(b.character);
    const bool is_same = have_same_skin && at_a == at_b;
    std::vector<PictureDiff> shots(scene.cameras.size());
    parallel_for(shots.size(), [&](std::size_t i) {
      const Camera& camera = kCameras[scene.cameras[i]];
      const View view = fit_view(at_a.positions, camera.angles);
      shots[i] = {camera.name, scene.clip, scene.time, {}, {}, {}};
      if (is_same && !keeps_pictures) return;
      Raster picture_a = drawn(of_a, at_a, view), picture_b = is_same ? picture_a : drawn(of_b, at_b, view);
      shots[i].difference = picture_difference(picture_a, picture_b);
      if (!keeps_pictures) return;
      shots[i].a = std::move(picture_a);
      shots[i].b = std::move(picture_b);
    });
    std::move(shots.begin(), shots.end(), std::back_inserter(pictures));
  }
  return pictures;
}

}  // namespace skinforge
