#include <fmt/format.h>

#include "stages/decoded_images.h"
#include "stages/inputs.h"
#include "stages/placed_surfaces.h"
#include "stages/stages.h"
#include "texture/junction_texture.h"

namespace skinforge {
namespace {

std::vector<FaceId> junction_faces(const JoinedSurface& joined) {
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < joined.faces.size(); ++f)
    if (joined.faces[f].site >= 0) faces.push_back(FaceId(f));
  return faces;
}

// Gives the junction its material, image and UV set 0.
void apply(Character& character, const std::vector<FaceId>& faces, JunctionTexture texture,
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

/// Colour for the junction, baked from its neighbours (Sec. 7.2 leaves this open).
class Texture final : public Stage {
 public:
  Texture(ArtifactNames names, const Recipe& recipe)
      : names_(std::move(names)), inputs_(input_names(recipe)) {}

  StageInfo info() const override {
    return {
        .name = "texture",
        .version = 1,
        .reads = joined(character_names(names_, inputs_),
                        {names_.graft(), names_.placed(), names_.surface(), names_.bound(), names_.shares()}),
        .writes = {names_.textured()}};
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    Character character = in.get<Character>(names_.bound());
    const auto& joined_surface = in.get<SurfaceResult>(names_.surface()).joined;
    const std::vector<FaceId> faces = junction_faces(joined_surface);
    if (!faces.empty()) apply(character, faces, bake(in, character, faces, issues), joined_surface);
    out.put(names_.textured(), std::move(character));
  }

 private:
  JunctionTexture bake(const StageInput& in, const Character& character, const std::vector<FaceId>& faces,
                       IssueSink& issues) const {
    const auto characters = get_characters(in, names_, inputs_);
    const auto& graft = in.get<Graft>(names_.graft());
    const auto& factors = in.get<std::vector<std::vector<double>>>(names_.shares());
    const PlacedSurfaces placed(in.get<std::vector<PolygonMesh>>(names_.placed()));
    std::vector<std::vector<Raster>> images;
    for (std::size_t i = 0; i < characters.size(); ++i)
      images.push_back(decoded_images(*characters[i], "input " + inputs_[i], issues));
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
