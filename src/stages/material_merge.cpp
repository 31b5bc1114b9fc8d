#include "stages/material_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace skinforge {
namespace {

using InputMaterial = std::pair<std::int32_t, MaterialId>;

std::string free_name(const std::vector<Material>& taken, const std::string& input,
                      const std::string& wanted) {
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(taken.begin(), taken.end(), [&](const Material& m) { return m.name == name; });
  };
  if (!is_taken(wanted)) return wanted;
  const std::string prefixed = fmt::format("{}_{}", input, wanted);
  std::string name = prefixed;
  for (int n = 2; is_taken(name); ++n) name = fmt::format("{}_{}", prefixed, n);
  return name;
}

std::array<std::optional<TextureRef>*, 5> textures_of(Material& m) {
  return {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
          &m.emissive_texture};
}

}  // namespace

void merge_materials(Character& result, const std::vector<const Character*>& inputs,
                     const std::vector<std::string>& input_names,
                     const std::vector<std::int32_t>& input_of_face) {
  std::set<InputMaterial> used;
  for (std::size_t f = 0; f < result.mesh.face_count(); ++f)
    if (input_of_face[f] >= 0 && result.mesh.face_material[f].is_valid())
      used.insert({input_of_face[f], result.mesh.face_material[f]});
  std::map<InputMaterial, MaterialId> renamed;
  std::map<std::pair<std::int32_t, ImageId>, ImageId> image_of;
  for (const InputMaterial& key : used) {
    const Character& input = *inputs[key.first];
    Material material = input.materials[key.second.index()];
    material.name = free_name(result.materials, input_names[key.first], material.name);
    for (auto* texture : textures_of(material)) {
      if (!*texture) continue;
      const auto [entry, is_new] =
          image_of.try_emplace({key.first, (*texture)->image}, ImageId(result.images.size()));
      if (is_new) result.images.push_back(input.images[(*texture)->image.index()]);
      (*texture)->image = entry->second;
    }
    renamed[key] = MaterialId(result.materials.size());
    result.materials.push_back(std::move(material));
  }
  for (std::size_t f = 0; f < result.mesh.face_count(); ++f) {
    MaterialId& material = result.mesh.face_material[f];
    if (material.is_valid())
      material = input_of_face[f] < 0 ? MaterialId() : renamed.at({input_of_face[f], material});
  }
}

}  // namespace skinforge
