#include <algorithm>

#include "stages/decoded_images.h"
#include "stages/inputs.h"
#include "stages/placed_surfaces.h"
#include "stages/stages.h"
#include "texture/color_steps.h"
#include "texture/junction_texture.h"

namespace skinforge {
namespace {

std::vector<FaceId> junction_faces(const JoinedSurface& joined) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < joined.faces.size(); ++f)
    if (joined.faces[f].site >= 0) faces.push_back(FaceId(f));
  return faces;
}

// Faces of each junction.
std::vector<std::vector<FaceId>> faces_of_sites(const JoinedSurface& joined) {
  std::vector<std::vector<FaceId>> sites(joined.junction_part.size());
  for (std::size_t f = 0; f < joined.faces.size(); ++f)
    if (joined.faces[f].site >= 0) sites[static_cast<std::size_t>(joined.faces[f].site)].push_back(FaceId(f));
  return sites;
}

// Gives the junction its material, image and UV set 0.
void apply(Character& character, const std::vector<FaceId>& faces, JunctionTexture& texture,
           const JoinedSurface& joined) {
  PolygonMesh& mesh = character.mesh;
  if (texture.base_color.width > 0) {
    texture.material.base_color_texture->image = ImageId(character.images.size());
    character.images.push_back({"junction", "image/png", encode_png(texture.base_color)});
    if (mesh.uvs.empty()) mesh.uvs.emplace_back(mesh.corner_count(), Vec2::Zero());
    std::size_t next = 0;
    for (const FaceId face : faces)
      for (std::size_t k = 0; k < mesh.face(face).size(); ++k)
        mesh.uvs[0][mesh.first_corner(face) + k] = texture.uv[next++];
    for (const PartId part : joined.junction_part)
      if (part.is_valid()) mesh.parts[part.index()].uv_sets = 1;
  }
  for (const FaceId face : faces) mesh.face_material[face.index()] = MaterialId(character.materials.size());
  character.materials.push_back(std::move(texture.material));
}

// The images of the result: those of the inputs, decoded before, and the junction's own as the last. Several
// images of the result may be the same image of an input.
std::vector<Raster> result_images(const Character& result, const std::vector<const Character*>& inputs,
                                  const std::vector<std::vector<Raster>>& decoded, Raster baked) {
  std::vector<Raster> images(result.images.size());
  for (std::size_t k = 0; k < images.size(); ++k)
    for (std::size_t i = 0; i < inputs.size() && images[k].width == 0; ++i)
      for (std::size_t n = 0; n < decoded[i].size() && images[k].width == 0; ++n)
        if (inputs[i]->images[n].bytes == result.images[k].bytes) images[k] = decoded[i][n];
  if (baked.width > 0) images.back() = std::move(baked);
  return images;
}

/// Colour for the junction, baked from its neighbours (Sec. 7.2 leaves this open).
class Texture final : public Stage {
 public:
  Texture(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), inputs_(input_names(recipe)) {}

  StageInfo info() const override {
    return {
        .name = "texture",
        .version = 2,
        .reads = joined(character_names(names_, inputs_),
                        {names_.graft(), names_.placed(), names_.surface(), names_.bound(), names_.shares()}),
        .writes = {names_.textured(), names_.color_steps()}};
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    Character character = in.get<Character>(names_.bound());
    const auto& joined_surface = in.get<SurfaceResult>(names_.surface()).joined;
    const std::vector<FaceId> faces = junction_faces(joined_surface);
    std::vector<ColorSteps> steps(joined_surface.junction_part.size());
    if (!faces.empty()) {
      const auto characters = get_characters(in, names_, inputs_);
      std::vector<std::vector<Raster>> images;
      for (std::size_t i = 0; i < characters.size(); ++i)
        images.push_back(decoded_images(*characters[i], "input " + inputs_[i], issues));
      JunctionTexture texture = bake(in, character, faces, characters, images);
      apply(character, faces, texture, joined_surface);
      const std::vector<Raster> shown =
          result_images(character, characters, images, std::move(texture.base_color));
      const auto sites = faces_of_sites(joined_surface);
      for (std::size_t k = 0; k < sites.size(); ++k)
        steps[k] = color_steps({&character.mesh, character.materials, shown}, sites[k]);
    }
    out.put(names_.color_steps(), std::move(steps));
    out.put(names_.textured(), std::move(character));
  }

 private:
  JunctionTexture bake(const StageInput& in, const Character& character, const std::vector<FaceId>& faces,
                       const std::vector<const Character*>& characters,
                       const std::vector<std::vector<Raster>>& images) const {
    const auto& graft = in.get<Graft>(names_.graft());
    const auto& factors = in.get<std::vector<std::vector<double>>>(names_.shares());
    const PlacedSurfaces placed(in.get<std::vector<PolygonMesh>>(names_.placed()));
    std::vector<TextureSource> sources;
    for (std::size_t s = 0; s < placed.count(); ++s) {
      const std::size_t input = graft.sources[s].input;
      sources.push_back({{&placed.mesh(s), characters[input]->materials, images[input]},
                         placed.mesh(s).positions,
                         &placed.triangles(s),
                         &placed.bvh(s),
                         factors[s]});
    }
    return bake_junction_texture({&character.mesh, faces}, sources);
  }

  ArtifactNames names_;
  std::vector<std::string> inputs_;
};

}  // namespace

StagePointer make_texture_stage(const ArtifactNames& names, const Recipe& recipe) {
  return std::make_unique<Texture>(names, recipe);
}

}  // namespace skinforge
