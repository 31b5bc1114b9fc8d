#include <fmt/format.h>

#include "stages/site_solids.h"
#include "stages/stages.h"
#include "stages/surface_options.h"

namespace skinforge {
namespace {

/// delta_R of one operation (Sec. 6.1), and the same as a file that other tools open.
class Field final : public Stage {
 public:
  Field(ArtifactNames names, const Recipe& recipe, std::size_t site)
      : names_(std::move(names)), site_(site), options_(field_options(recipe.operations[site])) {}

  StageInfo info() const override {
    return {.name = "field",
            .instance = std::to_string(site_ + 1),
            .version = 2,
            .reads = {names_.graft(), names_.placed(), names_.selection(), names_.groups()},
            .writes = {names_.field(site_), names_.vdb(site_)}};
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("site", site_);
    key.add_value("options", options_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink& issues) const override {
    SiteField field;
    for (const SiteGroup& group : in.get<std::vector<SiteGroup>>(names_.groups())) {
      if (group.front() != site_) continue;  // the first site of a group makes the field of all
      const SiteSolids solids =
          site_solids(in.get<Graft>(names_.graft()), group, in.get<std::vector<PolygonMesh>>(names_.placed()),
                      in.get<std::vector<SourceSelection>>(names_.selection()));
      if (solids.can_blend()) field = build_site_field(solids.solids, options_);
    }
    constexpr double kNoticed = 1.001;  // ours: rounding aside
    if (!field.is_empty() && options_.voxel > 0 && field.voxel() > kNoticed * options_.voxel)
      issues.warn(
          "voxel-enlarged", fmt::format("op {}", site_ + 1),
          fmt::format("voxels of {} m are too many here; they are {:.4g} m", options_.voxel, field.voxel()));
    out.put(names_.vdb(site_), field.is_empty() ? Bytes() : to_vdb(field.distance));
    out.put(names_.field(site_), std::move(field));
  }

 private:
  ArtifactNames names_;
  std::size_t site_;
  FieldOptions options_;
};

}  // namespace

StagePointer make_field_stage(const ArtifactNames& names, const Recipe& recipe, std::size_t site) {
  return std::make_unique<Field>(names, recipe, site);
}

}  // namespace skinforge
