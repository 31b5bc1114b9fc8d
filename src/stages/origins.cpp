#include "stages/origins.h"

namespace skinforge {
namespace {

// The input item of the same content as a result item; inputs in order, as merge_materials laid them out.
template <class Item, class Same>
Origin find_origin(const Item& item, const std::vector<const Character*>& inputs,
                   std::vector<Item> Character::*table, Same&& same) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::vector<Item>& items = inputs[i]->*table;
    for (std::size_t k = 0; k < items.size(); ++k)
      if (same(item, items[k], i)) return {static_cast<int>(i), static_cast<int>(k), ""};
  }
  return {};
}

std::vector<Origin> part_origins(const Graft& graft, const std::vector<const Character*>& inputs,
                                 const JoinedSurface& joined) {
  std::vector<Origin> origins(joined.mesh.parts.size());
  for (std::size_t s = 0; s < graft.sources.size(); ++s) {
    const std::size_t input = graft.sources[s].input;
    for (std::size_t p = 0; p < inputs[input]->mesh.parts.size(); ++p)
      origins[joined.first_part[s].index() + p] = {static_cast<int>(input), static_cast<int>(p), ""};
  }
  return origins;
}

// In each part the targets of its input stand before those that were made here, which have no origin.
std::vector<Origin> morph_origins(const Graft& graft, const std::vector<const Character*>& inputs,
                                  const JoinedSurface& joined, const Character& result) {
  std::vector<std::vector<Origin>> of_part(joined.mesh.parts.size());
  for (std::size_t s = 0; s < graft.sources.size(); ++s) {
    const std::size_t input = graft.sources[s].input;
    for (std::size_t m = 0; m < inputs[input]->morphs.size(); ++m)
      of_part[joined.first_part[s].index() + inputs[input]->morphs[m].part.index()].push_back(
          {static_cast<int>(input), static_cast<int>(m), ""});
  }
  std::vector<std::size_t> taken(of_part.size(), 0);
  std::vector<Origin> origins;
  for (const MorphTarget& target : result.morphs) {
    const std::size_t part = target.part.index(), next = taken[part]++;
    origins.push_back(next < of_part[part].size() ? of_part[part][next] : Origin());
  }
  return origins;
}

}  // namespace

ResultOrigins result_origins(const std::vector<const Character*>& inputs,
                             const std::vector<std::string>& input_names, const Graft& graft,
                             const JoinedSurface& joined, const Character& result,
                             std::span<const ClipRequest> clips) {
  ResultOrigins origins;
  for (const JointOrigin& joint : graft.origins)
    origins.joints.push_back(
        {static_cast<int>(graft.sources[joint.source.index()].input), joint.joint.value, ""});
  for (const ClipRequest& clip : clips)
    origins.clips.push_back({static_cast<int>(clip.input), static_cast<int>(clip.clip), ""});
  for (const Material& material : result.materials)
    origins.materials.push_back(find_origin(
        material, inputs, &Character::materials, [&](const Material& a, const Material& b, std::size_t i) {
          return a.name == b.name || a.name == input_names[i] + "_" + b.name;
        }));
  for (const Image& image : result.images)
    origins.images.push_back(
        find_origin(image, inputs, &Character::images,
                    [](const Image& a, const Image& b, std::size_t) { return a.bytes == b.bytes; }));
  origins.morphs = morph_origins(graft, inputs, joined, result);
  origins.parts = part_origins(graft, inputs, joined);
  return origins;
}

}  // namespace skinforge
