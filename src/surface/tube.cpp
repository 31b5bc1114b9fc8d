#include "surface/tube.h"

#include <algorithm>
#include <cmath>

#include "surface/raise_worst.h"
#include "surface/tube_mesh.h"

namespace skinforge {
namespace {

constexpr int kSamples = 64;  // ours: of the length along the tube

// Sum of the corners at a border vertex: pi where the tube goes straight on.
std::vector<double> border_angles(const TrianglePatch& domain, const IndexLoop& loop) {
  std::vector<double> sum(domain.positions.size(), 0);
  for (const Triangle& t : domain.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = domain.positions[t[(k + 1) % 3]] - domain.positions[t[k]],
                 q = domain.positions[t[(k + 2) % 3]] - domain.positions[t[k]];
      sum[t[k]] += std::atan2(p.cross(q).norm(), p.dot(q));
    }
  std::vector<double> angles;
  for (const std::int32_t v : loop) angles.push_back(sum[v]);
  return angles;
}

// Depth of the first preserved row, so rows go on at the same pace; near the border's own edges where that
// row is much deeper or flatter than they are.
double row_depth(const JunctionLoop& loop) {
  const double edge = loop_length(loop.positions) / static_cast<double>(loop.positions.size());
  double sum = 0;
  int count = 0;
  for (std::size_t v = 0; v < loop.positions.size(); ++v)
    for (const Vec3& p : loop.inward[v]) sum += (p - loop.positions[v]).norm(), ++count;
  return count == 0 ? edge : std::clamp(sum / count, edge / 2, 2 * edge);
}

// Values of u at which the rows lie: sizes go from those of A to those of B.
struct Rows {
  std::vector<double> u, share;  // #rows + 1; share of the length
};

// Rows from A to each sample of the length.
std::vector<double> rows_until(const std::vector<double>& lengths, double depth_a, double depth_b) {
  std::vector<double> rows = {0};
  for (std::size_t k = 0; k + 1 < lengths.size(); ++k) {
    const double middle = 0.5 * (lengths[k] + lengths[k + 1]) / lengths.back();
    rows.push_back(rows.back() +
                   (lengths[k + 1] - lengths[k]) / (depth_a * std::pow(depth_b / depth_a, middle)));
  }
  return rows;
}

Rows lay_rows(const std::vector<double>& lengths, double depth_a, double depth_b, int count) {
  const std::vector<double> until = rows_until(lengths, depth_a, depth_b);
  Rows rows;
  std::size_t k = 0;
  for (int r = 0; r <= count; ++r) {
    const double wanted = until.back() * r / count;
    while (k + 2 < until.size() && until[k + 1] < wanted) ++k;
    const double step = until[k + 1] - until[k];
    const double part = step > 0 ? std::clamp((wanted - until[k]) / step, 0.0, 1.0) : 0;
    rows.u.push_back((static_cast<double>(k) + part) / static_cast<double>(until.size() - 1));
    rows.share.push_back((lengths[k] + part * (lengths[k + 1] - lengths[k])) / lengths.back());
  }
  rows.u.front() = rows.share.front() = 0;
  rows.u.back() = rows.share.back() = 1;
  return rows;
}

// The tube's vertices on the domain. Border B runs the other way there.
QuadPatch lifted(const TubeMesh& mesh, const TubeChart& chart, const Rows& rows, const TrianglePatch& domain,
                 const IndexLoop& b) {
  QuadPatch patch{domain.positions, mesh.quads, mesh.triangles, domain.fixed};
  patch.positions.resize(domain.fixed);
  for (std::size_t v = domain.fixed; v < mesh.row.size(); ++v)
    patch.positions.push_back(chart.at(rows.u[static_cast<std::size_t>(mesh.row[v])], mesh.theta[v]));
  const auto first_b = static_cast<std::int32_t>(domain.fixed - b.size());
  const auto rename = [&](std::int32_t& v) {
    if (v >= first_b && v < static_cast<std::int32_t>(domain.fixed)) v = b[v - first_b];
  };
  for (Quad& q : patch.quads) std::for_each(q.begin(), q.end(), rename);
  for (Triangle& t : patch.triangles) std::for_each(t.begin(), t.end(), rename);
  return patch;
}

// Rows that let the counts meet: stacks need room, and columns between them that go through.
int least_rows(std::size_t n, std::size_t m) {
  if (n == m) return 2;
  const std::size_t diamonds = (std::max(n, m) - std::min(n, m) + 1) / 2, through = std::min(n, m);
  return 2 + std::clamp(static_cast<int>((diamonds + through - 1) / through), 1, TubeOptions().deepest);
}

}  // namespace

std::optional<QuadTube> QuadTube::make(const TrianglePatch& domain, const std::vector<JunctionLoop>& loops,
                                       std::string& fault) {
  const Borders borders = lay_borders(loops);
  const IndexLoop a = borders.loops[0], b(borders.loops[1].rbegin(), borders.loops[1].rend());
  auto chart = TubeChart::make(domain, a, b);
  if (!chart) {
    fault = "the blended surface has no coordinates of a tube";
    return std::nullopt;
  }
  QuadTube tube(domain, *std::move(chart));
  tube.b_ = b;
  tube.side_a_ = {tube.chart_.theta_a(), border_angles(domain, a)};
  tube.side_b_ = {tube.chart_.theta_b(), border_angles(domain, b)};
  tube.depth_a_ = row_depth(loops[0]);
  tube.depth_b_ = row_depth(loops[1]);
  tube.lengths_ = tube.chart_.lengths(kSamples);
  tube.wanted_rows_ =
      std::max(least_rows(a.size(), b.size()),
               static_cast<int>(std::lround(rows_until(tube.lengths_, tube.depth_a_, tube.depth_b_).back())));
  return tube;
}

std::optional<QuadPatch> QuadTube::with(int rows, const TubeOptions& options,
                                        const Projection& project) const {
  if (rows < 2) return std::nullopt;
  const auto table = solve_tube(side_a_, side_b_, rows, options);
  if (!table) return std::nullopt;
  const Rows laid = lay_rows(lengths_, depth_a_, depth_b_, rows);
  QuadPatch patch = lifted(mesh_of(*table, side_a_, side_b_, laid.share), chart_, laid, *domain_, b_);
  polish(patch, project);
  raise_worst(patch, project);
  return patch;
}

}  // namespace skinforge
