#include "io/glb_materials.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace skinforge {
namespace {

constexpr const char* kUnlit = "KHR_materials_unlit";
constexpr const char* kStrength = "KHR_materials_emissive_strength";
constexpr const char* kTransform = "KHR_texture_transform";

struct SamplerKey {
  Wrap wrap_u = Wrap::Repeat;
  Wrap wrap_v = Wrap::Repeat;
  bool nearest = false;

  auto operator<=>(const SamplerKey&) const = default;
};
using TextureKey = std::pair<ImageId, SamplerKey>;

std::size_t gl_wrap(Wrap wrap) {
  constexpr std::array<std::size_t, 3> kWraps = {10497, 33071, 33648};  // in the order of `Wrap`
  return kWraps[static_cast<std::size_t>(wrap)];
}

double unit(double value) {
  return std::clamp(value, 0.0, 1.0);
}

/// A table whose entries get their index when they are first asked for.
template <class Key>
class Numbered {
 public:
  std::size_t index(const Key& key) {
    const auto [entry, is_new] = index_.try_emplace(key, keys_.size());
    if (is_new) keys_.push_back(key);
    return entry->second;
  }
  const std::vector<Key>& keys() const { return keys_; }

 private:
  std::map<Key, std::size_t> index_;
  std::vector<Key> keys_;
};

class MaterialWriter {
 public:
  MaterialWriter(const Character& character, GlbBuffer& buffer, JsonText& json)
      : character_(character), buffer_(buffer), json_(json) {}

  std::set<std::string> write() {
    write_table("materials", character_.materials, [&](const Material& m) { write_material(m); });
    write_table("textures", textures_.keys(), [&](const TextureKey& t) { write_texture(t); });
    write_table("samplers", samplers_.keys(), [&](const SamplerKey& s) { write_sampler(s); });
    write_table("images", character_.images, [&](const Image& i) { write_image(i); });
    return extensions_;
  }

 private:
  template <class Item, class Body>
  void write_table(const char* name, const std::vector<Item>& items, Body&& body) {
    if (items.empty()) return;
    json_.key(name);
    json_.begin_array();
    for (const Item& item : items) {
      json_.begin_object();
      body(item);
      json_.end_object();
    }
    json_.end_array();
  }

  void write_material(const Material& m) {
    if (!m.name.empty()) json_.member("name", m.name);
    write_metallic_roughness(m);
    write_texture_info("normalTexture", m.normal_texture, "scale");
    write_texture_info("occlusionTexture", m.occlusion_texture, "strength");
    write_texture_info("emissiveTexture", m.emissive_texture);
    const double strength = std::max(m.emissive.maxCoeff(), 1.0);
    const Vec3 emissive = (m.emissive / strength).cwiseMax(0);
    if (!emissive.isZero(0)) json_.member("emissiveFactor", std::span<const double>(emissive.data(), 3));
    if (m.alpha_mode != AlphaMode::Opaque)
      json_.member("alphaMode", m.alpha_mode == AlphaMode::Mask ? "MASK" : "BLEND");
    if (m.alpha_mode == AlphaMode::Mask) json_.member("alphaCutoff", std::max(m.alpha_cutoff, 0.0));
    if (m.double_sided) json_.member("doubleSided", true);
    write_extensions(m, strength);
  }

  void write_metallic_roughness(const Material& m) {
    json_.key("pbrMetallicRoughness");
    json_.begin_object();
    const Vec4 color = m.base_color.cwiseMax(0).cwiseMin(1);
    json_.member("baseColorFactor", std::span<const double>(color.data(), 4));
    write_texture_info("baseColorTexture", m.base_color_texture);
    json_.member("metallicFactor", unit(m.metallic));
    json_.member("roughnessFactor", unit(m.roughness));
    write_texture_info("metallicRoughnessTexture", m.metallic_roughness_texture);
    json_.end_object();
  }

  void write_extensions(const Material& m, double strength) {
    if (!m.unlit && strength == 1) return;
    json_.key("extensions");
    json_.begin_object();
    if (strength != 1) {
      begin_extension(kStrength);
      json_.member("emissiveStrength", strength);
      json_.end_object();
    }
    if (m.unlit) {
      begin_extension(kUnlit);
      json_.end_object();
    }
    json_.end_object();
  }

  void begin_extension(const char* name) {
    extensions_.insert(name);
    json_.key(name);
    json_.begin_object();
  }

  void write_texture_info(const char* name, const std::optional<TextureRef>& ref,
                          const char* amount_name = nullptr) {
    if (!ref) return;
    json_.key(name);
    json_.begin_object();
    json_.member("index", textures_.index({ref->image, {ref->wrap_u, ref->wrap_v, ref->nearest}}));
    if (ref->uv_set > 0) json_.member("texCoord", static_cast<std::size_t>(ref->uv_set));
    if (amount_name != nullptr && ref->amount != 1)
      json_.member(amount_name,
                   std::string_view(amount_name) == "strength" ? unit(ref->amount) : ref->amount);
    write_transform(*ref);
    json_.end_object();
  }

  void write_transform(const TextureRef& ref) {
    if (ref.uv_offset.isZero(0) && ref.uv_scale == Vec2::Ones() && ref.uv_rotation == 0) return;
    json_.key("extensions");
    json_.begin_object();
    begin_extension(kTransform);
    json_.member("offset", std::span<const double>(ref.uv_offset.data(), 2));
    json_.member("rotation", ref.uv_rotation);
    json_.member("scale", std::span<const double>(ref.uv_scale.data(), 2));
    json_.end_object();
    json_.end_object();
  }

  void write_texture(const TextureKey& key) {
    json_.member("sampler", samplers_.index(key.second));
    json_.member("source", key.first.index());
  }

  void write_sampler(const SamplerKey& key) {
    constexpr std::size_t kNearest = 9728, kLinear = 9729, kLinearMipmapLinear = 9987;
    json_.member("magFilter", key.nearest ? kNearest : kLinear);
    json_.member("minFilter", key.nearest ? kNearest : kLinearMipmapLinear);
    json_.member("wrapS", gl_wrap(key.wrap_u));
    json_.member("wrapT", gl_wrap(key.wrap_v));
  }

  void write_image(const Image& image) {
    json_.member("bufferView", buffer_.add_view(image.bytes));
    json_.member("mimeType", image.mime);
    if (!image.name.empty()) json_.member("name", image.name);
  }

  const Character& character_;
  GlbBuffer& buffer_;
  JsonText& json_;
  Numbered<TextureKey> textures_;
  Numbered<SamplerKey> samplers_;
  std::set<std::string> extensions_;
};

}  // namespace

std::set<std::string> write_materials(const Character& character, GlbBuffer& buffer, JsonText& json) {
  return MaterialWriter(character, buffer, json).write();
}

}  // namespace skinforge
