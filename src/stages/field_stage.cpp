#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/limits.h"
#include "stages/site_solids.h"
#include "stages/stages.h"
#include "stages/surface_options.h"

namespace skinforge {
namespace {

/// delta_R of one operation (Sec. 6.1).
class Field final : public Stage {
 public:
  Field(ArtifactNames names, const Recipe& recipe, std::size_t site)
      : names_(std::move(names)), site_(site), options_(field_options(recipe.operations[site])) {}

  StageInfo info() const override {
    return {
        .name = "field",
        .instance = std::to_string(site_ + 1),
        .version = 5,
        .reads = {names_.placement(), names_.graft(), names_.placed(), names_.selection(), names_.groups()},
        .writes = {names_.field(site_)}};
  }
  void add_to_key(Hasher& key) const override {
    key.add_value("site", site_);
    key.add_value("options", options_);
  }

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    SiteField field;
    for (const SiteGroup& group : in.get<std::vector<SiteGroup>>(names_.groups())) {
      if (group.front() != site_) continue;  // the first site of a group makes the field of all
      const SiteSolids solids =
          site_solids(in.get<Graft>(names_.graft()), group, in.get<std::vector<PolygonMesh>>(names_.placed()),
                      in.get<std::vector<SourceSelection>>(names_.selection()));
      FieldOptions options = options_for(solids.solids);
      const auto& turns = in.get<PlacedOperations>(names_.placement()).turns;
      options.blend.op = turns[site_].op.value_or(options.blend.op);
      if (solids.can_blend()) field = build_site_field(solids.solids, options);
    }
    out.put(names_.field(site_), std::move(field));
  }

 private:
  // A voxel that the recipe asks for is taken as it is, or refused; one of our own choice grows instead.
  FieldOptions options_for(const std::vector<FusionSolid>& solids) const {
    if (options_.voxel <= 0) return options_;
    const LatticeCost cost = lattice_cost(solids, options_);
    if (cost.bytes > static_cast<double>(limits().memory))
      throw Error(ExitCode::StageFailed,
                  fmt::format("op {}: voxels of {} m make {:.3g} lattice points of {:.3g} bytes; {}",
                              site_ + 1, options_.voxel, cost.points, cost.bytes, limit_hint("memory")));
    FieldOptions wanted = options_;
    wanted.max_points = std::max(wanted.max_points, static_cast<std::size_t>(std::ceil(2 * cost.points)));
    return wanted;
  }

  ArtifactNames names_;
  std::size_t site_;
  FieldOptions options_;
};

/// The field of one operation as a file that other tools open; no bytes where there is none.
class VdbFile final : public Stage {
 public:
  VdbFile(ArtifactNames names, std::size_t site) : names_(std::move(names)), site_(site) {}

  StageInfo info() const override {
    return {.name = "vdb",
            .instance = std::to_string(site_ + 1),
            .version = 1,
            .reads = {names_.field(site_)},
            .writes = {names_.vdb(site_)}};
  }
  void add_to_key(Hasher&) const override {}

  void run(const StageInput& in, StageOutput& out, IssueSink&) const override {
    const auto& field = in.get<SiteField>(names_.field(site_));
    out.put(names_.vdb(site_), field.is_empty() ? Bytes() : to_vdb(field.distance));
  }

 private:
  ArtifactNames names_;
  std::size_t site_;
};

}  // namespace

StagePointer make_field_stage(const ArtifactNames& names, const Recipe& recipe, std::size_t site) {
  return std::make_unique<Field>(names, recipe, site);
}

StagePointer make_vdb_stage(const ArtifactNames& names, std::size_t site) {
  return std::make_unique<VdbFile>(names, site);
}

}  // namespace skinforge
