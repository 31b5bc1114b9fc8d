#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/archive.h"
#include "base/id.h"
#include "base/math.h"

namespace skinforge {

/// An image as the file has it: encoded bytes, never re-encoded on the way through.
struct Image {
  std::string name;
  std::string mime;  ///< "image/png" or "image/jpeg"
  Bytes bytes;

  template <class Archive>
  friend void fields(Archive& a, Image& i) {
    a(i.name, i.mime, i.bytes);
  }
};

/// Decoded pixels, row by row from the top, RGBA, 8 bits each, sRGB as stored.
struct Raster {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height

  template <class Archive>
  friend void fields(Archive& a, Raster& r) {
    a(r.width, r.height, r.rgba);
  }
};

enum class Wrap : std::uint8_t { Repeat, ClampToEdge, MirroredRepeat };

/// Use of an image by a material.
struct TextureRef {
  ImageId image;
  int uv_set = 0;
  Wrap wrap_u = Wrap::Repeat;
  Wrap wrap_v = Wrap::Repeat;
  bool nearest = false;           ///< point sampling instead of linear filtering
  double amount = 1;              ///< normal scale or occlusion strength; 1 elsewhere
  Vec2 uv_offset = Vec2::Zero();  ///< KHR_texture_transform
  Vec2 uv_scale = Vec2::Ones();
  double uv_rotation = 0;  ///< radians

  template <class Archive>
  friend void fields(Archive& a, TextureRef& t) {
    a(t.image, t.uv_set, t.wrap_u, t.wrap_v, t.nearest, t.amount, t.uv_offset, t.uv_scale, t.uv_rotation);
  }
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// glTF 2.0 metallic-roughness material; defaults are those of the format.
struct Material {
  std::string name;
  Vec4 base_color = Vec4::Ones();  ///< linear RGBA factor
  double metallic = 1;
  double roughness = 1;
  Vec3 emissive = Vec3::Zero();
  std::optional<TextureRef> base_color_texture;
  std::optional<TextureRef> metallic_roughness_texture;
  std::optional<TextureRef> normal_texture;
  std::optional<TextureRef> occlusion_texture;
  std::optional<TextureRef> emissive_texture;
  AlphaMode alpha_mode = AlphaMode::Opaque;
  double alpha_cutoff = 0.5;
  bool double_sided = false;
  bool unlit = false;  ///< KHR_materials_unlit

  template <class Archive>
  friend void fields(Archive& a, Material& m) {
    a(m.name, m.base_color, m.metallic, m.roughness, m.emissive, m.base_color_texture,
      m.metallic_roughness_texture, m.normal_texture, m.occlusion_texture, m.emissive_texture, m.alpha_mode,
      m.alpha_cutoff, m.double_sided, m.unlit);
  }
};

}  // namespace skinforge
