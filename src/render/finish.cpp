#include "render/finish.h"

#include "render/visibility.h"

namespace skinforge {
namespace {

using Vec4f = Eigen::Vector4f;

constexpr float kHighlightShare = 0.62F;  // ours: the material still shows through
constexpr float kTintRoughness = 0.7F;    // ours: of surfaces drawn in vertex colours
// ours: metalness without its texture would turn whole characters grey, for exporters write factor 1 with a
// texture
constexpr float kUnknownMetallic = 0, kUnknownRoughness = 0.65F;

Vec4f sampled(const Subject& subject, const TextureRef& ref, const SubjectPoint& point) {
  const auto& mesh = subject.mesh();
  const FaceId face = subject.face_of(point.triangle);
  const auto set = static_cast<std::size_t>(ref.uv_set);
  if (set >= mesh.uvs.size() || ref.uv_set >= mesh.parts[mesh.face_part[face.index()].index()].uv_sets)
    return Vec4f::Ones();
  const auto& corners = subject.triangle_corners()[point.triangle];
  const Vec2 uv = point.weights.mix<Vec2>(mesh.uvs[set], corners);
  return subject.textures().sample(ref, uv.cast<float>(), point.spread);
}

bool has_colors(const PolygonMesh& mesh, FaceId face) {
  return !mesh.colors.empty() && mesh.parts[mesh.face_part[face.index()].index()].has_colors;
}

Vec3f emissive_at(const Subject& subject, const Material& material, const SubjectPoint& point) {
  const Vec3f emissive = material.emissive.cast<float>();
  if (!material.emissive_texture || emissive.isZero()) return emissive;
  return emissive.cwiseProduct(sampled(subject, *material.emissive_texture, point).head<3>());
}

}  // namespace

Vec4f base_color_at(const Subject& subject, const SubjectPoint& point) {
  const FaceId face = subject.face_of(point.triangle);
  const Material& material = subject.material_of(face);
  Vec4f color = material.base_color.cast<float>();
  if (material.base_color_texture)
    color = color.cwiseProduct(sampled(subject, *material.base_color_texture, point));
  if (has_colors(subject.mesh(), face)) {
    const auto& corners = subject.triangle_corners()[point.triangle];
    color = color.cwiseProduct(point.weights.mix<Vec4>(subject.mesh().colors, corners).cast<float>());
  }
  return color;
}

Finish finish_at(const Subject& subject, const DrawOptions& options, const SubjectPoint& point,
                 bool is_highlighted) {
  Finish finish;
  if (!options.vertex_colors.empty()) {
    finish.albedo =
        point.weights.mix<Vec3>(options.vertex_colors, subject.triangles()[point.triangle]).cast<float>();
    finish.roughness = kTintRoughness;
  } else {
    const Material& material = subject.material_of(subject.face_of(point.triangle));
    const bool textured = material.metallic_roughness_texture.has_value();
    finish.albedo = base_color_at(subject, point).head<3>();
    finish.emissive = emissive_at(subject, material, point);
    finish.metallic = textured ? kUnknownMetallic : static_cast<float>(material.metallic);
    finish.roughness = textured ? kUnknownRoughness : static_cast<float>(material.roughness);
    finish.is_unlit = material.unlit;
  }
  if (is_highlighted)
    finish.albedo += kHighlightShare * (options.highlight_color.cast<float>() - finish.albedo);
  return finish;
}

bool exists_at(const Subject& subject, const SubjectPoint& point, int sample) {
  const FaceId face = subject.face_of(point.triangle);
  const Material& material = subject.material_of(face);
  const float alpha = base_color_at(subject, point).w();
  if (material.alpha_mode == AlphaMode::Mask) return alpha >= static_cast<float>(material.alpha_cutoff);
  const int threshold =
      (sample * 5 + face.value * 7) % kSamples;  // another order per face: layers do not coincide
  return alpha * kSamples > static_cast<float>(threshold) + 0.5F;
}

}  // namespace skinforge
