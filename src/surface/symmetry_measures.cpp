#include "surface/symmetry_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/expect.h"

namespace skinforge {
namespace {

// The faces of one junction, or of two that are each other's images, with their borders first.
class Faces {
 public:
  Faces(const JoinedSurface& joined, std::span<const Junction> junctions, std::vector<std::size_t> sites)
      : joined_(joined), sites_(std::move(sites)) {
    std::map<std::pair<SourceId, VertexId>, std::int32_t> names;
    for (std::size_t v = 0; v < joined.vertices.size(); ++v)
      if (joined.vertices[v].source.is_valid())
        names[{joined.vertices[v].source, joined.vertices[v].vertex}] = static_cast<std::int32_t>(v);
    for (const std::size_t s : sites_)
      for (const JunctionLoop& loop : junctions[s].loops)
        for (const VertexId v : loop.vertices) add_vertex(names.at({loop.source, v}));
    patch_.fixed = patch_.positions.size();
    for (std::size_t f = 0; f < joined.faces.size(); ++f)
      if (std::count(sites_.begin(), sites_.end(), static_cast<std::size_t>(joined.faces[f].site)) > 0)
        add_face(joined.mesh.face(FaceId(f)));
  }

  const QuadPatch& patch() const { return patch_; }
  double mean_edge() const { return edges_ > 0 ? length_ / edges_ : 1; }

 private:
  std::int32_t add_vertex(std::int32_t v) {
    const auto [entry, is_new] = name_.try_emplace(v, static_cast<std::int32_t>(patch_.positions.size()));
    if (is_new) patch_.positions.push_back(joined_.mesh.positions[static_cast<std::size_t>(v)]);
    return entry->second;
  }

  void add_face(std::span<const VertexId> face) {
    std::vector<std::int32_t> corners;
    for (const VertexId v : face) corners.push_back(add_vertex(v.value));
    for (std::size_t k = 0; k < corners.size(); ++k, edges_ += 1)
      length_ += (patch_.positions[corners[k]] - patch_.positions[corners[(k + 1) % corners.size()]]).norm();
    if (corners.size() == 4) patch_.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
    if (corners.size() == 3) patch_.triangles.push_back({corners[0], corners[1], corners[2]});
  }

  const JoinedSurface& joined_;
  std::vector<std::size_t> sites_;
  std::map<std::int32_t, std::int32_t> name_;
  QuadPatch patch_;
  double length_ = 0, edges_ = 0;
};

// What mirroring does to the borders of `sites` together.
PatchMirror borders_of(std::span<const Junction> junctions, const std::vector<std::size_t>& sites) {
  PatchMirror borders = junctions[sites[0]].symmetry.borders;
  if (sites.size() == 1) return borders;
  const auto count = static_cast<std::int32_t>(borders.image.size());
  for (std::int32_t& v : borders.image) v += count;
  const auto& back = junctions[sites[1]].symmetry.borders.image;
  borders.image.insert(borders.image.end(), back.begin(), back.end());
  return borders;
}

double to_nearest(const QuadPatch& patch, const Vec3& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t w = patch.fixed; w < patch.positions.size(); ++w)
    nearest = std::min(nearest, (patch.positions[w] - place).norm());
  return nearest;
}

}  // namespace

std::optional<SymmetryMeasures> measure_symmetry(const JoinedSurface& joined,
                                                 std::span<const Junction> junctions, std::size_t site) {
  const std::int32_t image = junctions[site].symmetry.site;
  if (image < 0 || junctions[site].patch.triangles.empty()) return std::nullopt;
  std::vector<std::size_t> sites = {site};
  if (static_cast<std::size_t>(image) != site) sites.push_back(static_cast<std::size_t>(image));
  const PatchMirror borders = borders_of(junctions, sites);
  const Faces faces(joined, junctions, sites);
  const QuadPatch& patch = faces.patch();
  SF_EXPECT(borders.image.size() == patch.fixed);
  const auto mirror = mirror_of(patch, borders);
  SymmetryMeasures measures;
  measures.faces_symmetric = mirror.has_value();
  for (std::size_t v = 0; v < patch.positions.size(); ++v) {
    const Vec3 place = borders.plane.mirrored(patch.positions[v]);
    const bool is_border = v < patch.fixed;
    const auto image_of = [&](const std::vector<std::int32_t>& images) {
      return (patch.positions[static_cast<std::size_t>(images[v])] - place).norm() / faces.mean_edge();
    };
    if (is_border) {
      measures.border_max = std::max(measures.border_max, image_of(borders.image));
      continue;
    }
    const double off = mirror ? image_of(mirror->image) : to_nearest(patch, place) / faces.mean_edge();
    measures.max = std::max(measures.max, off);
    measures.mean += off / static_cast<double>(patch.positions.size() - patch.fixed);
  }
  return measures;
}

}  // namespace skinforge
