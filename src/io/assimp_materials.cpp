#include "io/assimp_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "io/assimp_values.h"
#include "io/export.h"
#include "io/image_codec.h"

namespace skinforge {
namespace {

constexpr double kClassicRoughness = 1;  // Phong and Lambert have none; matt is the least surprising
constexpr double kFbxDiffuse = 0.8;      // default of the FBX SDK, as its exporters write it

std::optional<Vec3> color(const aiMaterial& m, const char* key, unsigned type, unsigned index) {
  aiColor4D c;
  if (m.Get(key, type, index, c) != aiReturn_SUCCESS) return std::nullopt;
  return Vec3(c.r, c.g, c.b).cwiseMax(0.0).cwiseMin(1.0);
}

std::optional<double> number(const aiMaterial& m, const char* key, unsigned type, unsigned index) {
  float value = 0;
  if (m.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value)) return std::nullopt;
  return static_cast<double>(value);
}

Wrap to_wrap(aiTextureMapMode mode) {
  if (mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal) return Wrap::ClampToEdge;
  return mode == aiTextureMapMode_Mirror ? Wrap::MirroredRepeat : Wrap::Repeat;
}

/// Encoded bytes of an embedded image; raw pixels become a PNG.
Bytes embedded_bytes(const aiTexture& texture) {
  if (texture.mHeight == 0) {
    const auto* begin = reinterpret_cast<const std::byte*>(texture.pcData);
    return {begin, begin + texture.mWidth};
  }
  Raster raster{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
  const std::size_t pixels = std::size_t{texture.mWidth} * texture.mHeight;
  for (std::size_t i = 0; i < pixels; ++i) {
    const aiTexel& t = texture.pcData[i];
    raster.rgba.insert(raster.rgba.end(), {t.r, t.g, t.b, t.a});
  }
  return encode_png(raster);
}

class MaterialReader {
 public:
  MaterialReader(const aiScene& source, bool is_fbx, const MemoryIoSystem& files, RawScene& scene)
      : source_(source), is_fbx_(is_fbx), files_(files), scene_(scene) {}

  Material read(const aiMaterial& m) {
    Material result;
    aiString name;
    if (m.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) result.name = printable(to_text(name));
    place_ = "material " + result.name;
    result.base_color << base_color(m), opacity(m);
    result.metallic = number(m, AI_MATKEY_METALLIC_FACTOR).value_or(0);
    result.roughness =
        std::clamp(number(m, AI_MATKEY_ROUGHNESS_FACTOR).value_or(kClassicRoughness), 0.0, 1.0);
    result.emissive = color(m, AI_MATKEY_COLOR_EMISSIVE).value_or(Vec3::Zero());
    int two_sided = 0;
    result.double_sided = m.Get(AI_MATKEY_TWOSIDED, two_sided) == aiReturn_SUCCESS && two_sided != 0;
    if (result.base_color.w() < 1) result.alpha_mode = AlphaMode::Blend;
    read_textures(m, result);
    return result;
  }

 private:
  /// FBX: DiffuseColor * DiffuseFactor, which FBX2glTF 0.9.7 takes for linear as well.
  Vec3 base_color(const aiMaterial& m) const {
    const auto base = color(m, AI_MATKEY_BASE_COLOR), diffuse = color(m, AI_MATKEY_COLOR_DIFFUSE);
    return base ? *base : diffuse.value_or(Vec3::Constant(is_fbx_ ? kFbxDiffuse : 1));
  }

  /// FBX: what shines through is TransparentColor * TransparencyFactor, multiplied by Assimp. A wholly
  /// invisible material is taken for an exporter that filled one of the two by habit.
  double opacity(const aiMaterial& m) {
    const auto tint = color(m, AI_MATKEY_COLOR_TRANSPARENT);
    const auto factor = number(m, AI_MATKEY_TRANSPARENCYFACTOR);
    double value = number(m, AI_MATKEY_OPACITY).value_or(1);
    if (is_fbx_ && tint && factor) value = 1 - tint->mean();
    value = std::clamp(value, 0.0, 1.0);
    if (value > 0) return value;
    scene_.issues.push_back({"material-invisible", Severity::Warning, place_,
                             "the material is wholly transparent; taken as opaque"});
    return 1;
  }

  void read_textures(const aiMaterial& m, Material& result) {
    result.base_color_texture = first_texture(m, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    result.normal_texture = first_texture(m, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA});
    result.emissive_texture = first_texture(m, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
    result.occlusion_texture = first_texture(m, {aiTextureType_AMBIENT_OCCLUSION});
    if (is_fbx_ && result.base_color_texture) result.base_color.head<3>().setOnes();  // FBX: it replaces
    if (result.emissive_texture && result.emissive.isZero(0)) result.emissive.setOnes();
  }

  std::optional<TextureRef> first_texture(const aiMaterial& m, std::initializer_list<aiTextureType> types) {
    for (const aiTextureType type : types)
      if (m.GetTextureCount(type) > 0)
        if (auto texture = read_texture(m, type)) return texture;
    return std::nullopt;
  }

  std::optional<TextureRef> read_texture(const aiMaterial& m, aiTextureType type) {
    aiString path;
    unsigned uv_set = 0;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (m.GetTexture(type, 0, &path, nullptr, &uv_set, nullptr, nullptr, modes) != aiReturn_SUCCESS)
      return std::nullopt;
    const ImageId image = image_of(to_text(path));
    if (!image.is_valid()) return std::nullopt;
    TextureRef texture;
    texture.image = image;
    texture.uv_set = static_cast<int>(std::min(uv_set, unsigned{AI_MAX_NUMBER_OF_TEXTURECOORDS - 1}));
    texture.wrap_u = to_wrap(modes[0]);
    texture.wrap_v = to_wrap(modes[1]);
    return texture;
  }

  /// Each image once; invalid when it is not there or in a format we do not carry.
  ImageId image_of(const std::string& path) {
    const auto known = images_.find(path);
    if (known != images_.end()) return known->second;
    ImageId id;
    try {
      if (const auto bytes = bytes_of(path)) id = add_image(path, *bytes);
    } catch (const Error& error) {
      scene_.issues.push_back({"image-unreadable", Severity::Warning, place_,
                               fmt::format("image \"{}\": {}", printable(path), error.what())});
    }
    return images_[path] = id;
  }

  std::optional<Bytes> bytes_of(const std::string& path) {
    if (const aiTexture* texture = source_.GetEmbeddedTexture(path.c_str())) return embedded_bytes(*texture);
    if (const InputFile* file = files_.find(path)) return file->bytes;
    scene_.issues.push_back({"image-missing", Severity::Warning, place_,
                             fmt::format("image \"{}\" is not there", printable(path))});
    return std::nullopt;
  }

  ImageId add_image(const std::string& path, const Bytes& bytes) {
    const std::string name = path.substr(path.find_last_of("/\\") + 1);
    scene_.images.push_back({printable(name), inspect_image(bytes).mime, bytes});
    return ImageId(scene_.images.size() - 1);
  }

  const aiScene& source_;
  bool is_fbx_;
  const MemoryIoSystem& files_;
  RawScene& scene_;
  std::string place_;
  std::map<std::string, ImageId> images_;
};

/// Assimp's stand-in has a name and a colour, nothing else.
bool is_stand_in(const aiMaterial& m) {
  aiString name;
  return m.mNumProperties <= 2 && m.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS &&
         to_text(name) == AI_DEFAULT_MATERIAL_NAME;
}

}  // namespace

std::vector<std::int32_t> read_materials(const aiScene& source, bool is_fbx, const MemoryIoSystem& files,
                                         RawScene& scene) {
  MaterialReader reader(source, is_fbx, files, scene);
  std::vector<std::int32_t> places;
  for (unsigned m = 0; m < source.mNumMaterials; ++m) {
    const aiMaterial& material = *source.mMaterials[m];
    places.push_back(is_stand_in(material) ? -1 : static_cast<std::int32_t>(scene.materials.size()));
    if (places.back() >= 0) scene.materials.push_back(reader.read(material));
  }
  return places;
}

}  // namespace skinforge
