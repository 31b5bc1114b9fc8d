#include "io/gltf_materials.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "io/gltf_uri.h"
#include "io/image_codec.h"

namespace skinforge {
namespace {

constexpr std::size_t kRepeat = 10497, kClampToEdge = 33071, kMirroredRepeat = 33648, kNearest = 9728;
constexpr std::size_t kMaxUvSets = 8;  // ours: far above what any tool writes

class MaterialReader {
 public:
  MaterialReader(const GltfDocument& document, RawScene& scene, IssueSink& issues)
      : document_(document), scene_(scene), issues_(issues) {}

  void read() {
    for (const JsonPlace& place : document_.root.objects("images")) read_image(place);
    samplers_ = document_.root.objects("samplers");
    textures_ = document_.root.objects("textures");
    for (const JsonPlace& place : document_.root.objects("materials")) read_material(place);
  }

 private:
  void read_image(const JsonPlace& place) {
    Image image;
    image.name = place.text_or("name", "");
    std::optional<std::string> fault;
    if (auto bytes = image_bytes(place))
      fault = adopt(std::move(*bytes), image);
    else
      fault = fmt::format("no file \"{}\"", printable(place.get("uri").text()));
    image_ids_.push_back(fault ? ImageId() : ImageId(scene_.images.size()));
    if (fault)
      issues_.warn("image-left-out", document_.at(place), *fault + "; the image and its uses are left out");
    else
      scene_.images.push_back(std::move(image));
  }

  /// Gives the bytes to the image; what is wrong with them, if something is.
  static std::optional<std::string> adopt(Bytes bytes, Image& image) {
    try {
      image.mime = inspect_image(bytes).mime;
      image.bytes = std::move(bytes);
      return std::nullopt;
    } catch (const Error& error) {
      return error.what();
    }
  }

  /// None when the image is a file that is not there.
  std::optional<Bytes> image_bytes(const JsonPlace& place) const {
    if (const auto view = place.find("bufferView")) {
      const auto bytes =
          document_.accessors.view(view->index(document_.accessors.view_count(), "buffer view"));
      return Bytes(bytes.begin(), bytes.end());
    }
    const JsonPlace uri = place.get("uri");
    return with_context(uri.place(), [&]() -> std::optional<Bytes> {
      if (is_data_uri(uri.text())) return decode_data_uri(uri.text());
      const InputFile* file = find_file(*document_.files, uri.text());
      return file == nullptr ? std::nullopt : std::optional(file->bytes);
    });
  }

  std::optional<TextureRef> texture(const JsonPlace& owner, const char* key, const char* amount_key = "") {
    const auto info = owner.find(key);
    if (!info) return std::nullopt;
    const JsonPlace& entry = textures_at(*info);
    const auto source = entry.find("source");
    if (!source) {
      issues_.warn("texture-left-out", document_.at(entry), "the texture names no PNG or JPEG image");
      return std::nullopt;
    }
    TextureRef ref;
    ref.image = image_ids_[source->index(image_ids_.size(), "image")];
    if (!ref.image.is_valid()) return std::nullopt;
    ref.uv_set = uv_set(*info, 0);
    if (*amount_key != '\0') ref.amount = info->number_or(amount_key, 1);
    read_sampler(entry, ref);
    read_transform(*info, ref);
    return ref;
  }

  const JsonPlace& textures_at(const JsonPlace& info) const {
    return textures_[info.get("index").index(textures_.size(), "texture")];
  }

  static int uv_set(const JsonPlace& owner, int fallback) {
    const auto set = owner.find("texCoord");
    return set ? static_cast<int>(set->index(kMaxUvSets, "UV set")) : fallback;
  }

  static Wrap wrap(const JsonPlace& sampler, const char* key) {
    switch (sampler.count_or(key, kRepeat)) {
      case kRepeat:
        return Wrap::Repeat;
      case kClampToEdge:
        return Wrap::ClampToEdge;
      case kMirroredRepeat:
        return Wrap::MirroredRepeat;
      default:
        sampler.get(key).fail("is none of 10497, 33071, 33648");
    }
  }

  void read_sampler(const JsonPlace& entry, TextureRef& ref) const {
    const auto reference = entry.find("sampler");
    if (!reference) return;
    const JsonPlace& sampler = samplers_[reference->index(samplers_.size(), "sampler")];
    ref.wrap_u = wrap(sampler, "wrapS");
    ref.wrap_v = wrap(sampler, "wrapT");
    ref.nearest = sampler.count_or("magFilter", 0) == kNearest;
  }

  static std::optional<JsonPlace> extension(const JsonPlace& owner, const char* name) {
    const auto extensions = owner.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
  }

  static void read_transform(const JsonPlace& info, TextureRef& ref) {
    const auto transform = extension(info, "KHR_texture_transform");
    if (!transform) return;
    if (const auto offset = transform->find("offset")) ref.uv_offset = Vec2(offset->numbers(2).data());
    if (const auto scale = transform->find("scale")) ref.uv_scale = Vec2(scale->numbers(2).data());
    ref.uv_rotation = transform->number_or("rotation", 0);
    ref.uv_set = uv_set(*transform, ref.uv_set);
  }

  void read_material(const JsonPlace& place) {
    Material material;
    material.name = place.text_or("name", "");
    const auto glossy = extension(place, "KHR_materials_pbrSpecularGlossiness");
    if (const auto metallic = place.find("pbrMetallicRoughness"))
      read_metallic_roughness(*metallic, material);
    else if (glossy)
      read_specular_glossiness(*glossy, material);
    material.normal_texture = texture(place, "normalTexture", "scale");
    material.occlusion_texture = texture(place, "occlusionTexture", "strength");
    material.emissive_texture = texture(place, "emissiveTexture");
    if (const auto emissive = place.find("emissiveFactor"))
      material.emissive = Vec3(emissive->numbers(3).data());
    if (const auto strong = extension(place, "KHR_materials_emissive_strength"))
      material.emissive *= strong->number_or("emissiveStrength", 1);
    material.alpha_mode = alpha_mode(place);
    material.alpha_cutoff = place.number_or("alphaCutoff", material.alpha_cutoff);
    material.double_sided = place.flag_or("doubleSided", false);
    material.unlit = extension(place, "KHR_materials_unlit").has_value();
    scene_.materials.push_back(std::move(material));
  }

  void read_metallic_roughness(const JsonPlace& place, Material& material) {
    if (const auto color = place.find("baseColorFactor"))
      material.base_color = Vec4(color->numbers(4).data());
    material.metallic = place.number_or("metallicFactor", 1);
    material.roughness = place.number_or("roughnessFactor", 1);
    material.base_color_texture = texture(place, "baseColorTexture");
    material.metallic_roughness_texture = texture(place, "metallicRoughnessTexture");
  }

  void read_specular_glossiness(const JsonPlace& place, Material& material) {
    if (const auto color = place.find("diffuseFactor")) material.base_color = Vec4(color->numbers(4).data());
    material.base_color_texture = texture(place, "diffuseTexture");
    material.metallic = 0;
    material.roughness = 1 - place.number_or("glossinessFactor", 1);
    issues_.warn(
        "material-converted", document_.at(place),
        "specular-glossiness became metallic-roughness; specular colour and glossiness texture are left out");
  }

  static AlphaMode alpha_mode(const JsonPlace& place) {
    const std::string mode = place.text_or("alphaMode", "OPAQUE");
    if (mode == "MASK") return AlphaMode::Mask;
    if (mode == "BLEND") return AlphaMode::Blend;
    if (mode != "OPAQUE") place.get("alphaMode").fail("is none of OPAQUE, MASK, BLEND");
    return AlphaMode::Opaque;
  }

  const GltfDocument& document_;
  RawScene& scene_;
  IssueSink& issues_;
  std::vector<ImageId> image_ids_;  ///< per image of the file; invalid = left out
  std::vector<JsonPlace> samplers_;
  std::vector<JsonPlace> textures_;
};

}  // namespace

void read_materials(const GltfDocument& document, RawScene& scene, IssueSink& issues) {
  MaterialReader(document, scene, issues).read();
}

}  // namespace skinforge
