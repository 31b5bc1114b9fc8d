#pragma once

#include <optional>
#include <vector>

#include "render/depth_map.h"
#include "render/view.h"

namespace skinforge {

/// What the lights do at one point of the surface.
struct SurfacePoint {
  Vec3f position;
  Vec3f normal;  ///< unit, on the side that is seen
  Vec3f to_eye;  ///< unit
};

/// How a surface answers light; linear RGB.
struct Finish {
  Vec3f albedo = Vec3f::Ones();
  Vec3f emissive = Vec3f::Zero();
  float metallic = 0;
  float roughness = 1;
  bool is_unlit = false;  ///< shown as albedo + emissive, whatever the light
};

/// A photographer's set around a character: a pale sky dome that knows what hides it (shadow maps along a fan
/// of axes), one warm key light with soft shadows, a weak cool fill and a rim light from behind. The lamps
/// turn with the camera's yaw, so every view is lit alike. Immutable after construction.
class Lighting {
 public:
  /// `detail`: texels along the key light's shadow map; the sky's maps are coarser. `floor`: height of the
  /// floor, if there is one (metres, model space). Cost: nine depth maps.
  Lighting(std::span<const Vec3f> positions, std::span<const TriangleIndices> triangles, const View& view,
           int detail, std::optional<double> floor);

  /// Share of the sky that a point of the surface sees, weighted by how it faces, in [0, 1]. The costly part
  /// of a shade.
  float sky_light(const Vec3f& position, const Vec3f& normal) const;

  /// Linear RGB of the surface as seen, soft-limited to [0, 1]. `sky`: its `sky_light`.
  Vec3f shade(const SurfacePoint& point, const Finish& finish, float sky) const;

  /// Share of light that the floor keeps at the point where the ray meets it, in [0, 1]; 1 where it is
  /// unshaded, far from the character or not met.
  float floor_light(const Vec3f& eye, const Vec3f& ray) const;

 private:
  float key_light(const Vec3f& position, const Vec3f& normal) const;
  void light_floor(float height);
  float floor_share(const Vec3f& p, float sky) const;

  Vec3f center_;
  float radius_;
  Vec3f key_direction_, fill_direction_, rim_direction_;
  std::vector<DepthMap> sky_;
  std::optional<DepthMap> key_;
  std::optional<float> floor_;
  std::vector<float> floor_map_;  ///< share of the sky seen, on a square grid
};

}  // namespace skinforge
