#include "stages/decoded_images.h"

#include "render/shrink.h"

namespace skinforge {

std::vector<Raster> decoded_images(const Character& character, const std::string& place, IssueSink& issues,
                                   int max_width) {
  std::vector<char> shown(character.images.size(), 0);
  for (const Material& m : character.materials)
    for (const auto* texture : {&m.base_color_texture, &m.emissive_texture, &m.metallic_roughness_texture})
      if (*texture) shown[(*texture)->image.index()] = 1;
  std::vector<Raster> rasters(character.images.size());
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    if (!shown[i]) continue;
    try {
      rasters[i] = decode_image(character.images[i]);
      if (max_width > 0) rasters[i] = shrunk(rasters[i], max_width);
    } catch (const Error& error) {
      issues.warn("image-not-decoded", place, error.what());
    }
  }
  return rasters;
}

}  // namespace skinforge
