#include "surface/tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/symmetric_table.h"
#include "surface/tube_mesh.h"

namespace skinforge {
namespace {

constexpr int kSamples = 64;  // ours: of the length along the tube

// Sum of the corners at each vertex of the domain.
std::vector<double> corner_sums(const TrianglePatch& domain) {
  std::vector<double> sum(domain.positions.size(), 0);
  for (const Triangle& t : domain.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = domain.positions[t[(k + 1) % 3]] - domain.positions[t[k]],
                 q = domain.positions[t[(k + 2) % 3]] - domain.positions[t[k]];
      sum[t[k]] += std::atan2(p.cross(q).norm(), p.dot(q));
    }
  return sum;
}

// Theta and angle at the points of a border; between vertices of the domain it runs straight.
TubeSide side_of(const TubeBorder& border, const std::vector<double>& theta,
                 const std::vector<double>& angles) {
  TubeSide side;
  for (const TubeBorderPoint& point : border.points) {
    const auto k = static_cast<std::size_t>(point.place);
    const double part = point.place - static_cast<double>(k);
    const double next = k + 1 < theta.size() ? theta[k + 1] : theta[0] + 1;
    side.theta.push_back(theta[k] + part * (next - theta[k]));
    side.angle.push_back(point.place == static_cast<double>(k) ? angles[border.loop[k]] : std::numbers::pi);
  }
  return side;
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

// The tube's vertices on the domain.
QuadPatch lifted(const TubeMesh& mesh, const TubeChart& chart, const Rows& rows, const TubeDomain& domain) {
  const std::size_t borders = domain.a.points.size() + domain.b.points.size();
  QuadPatch patch{domain.patch.positions, mesh.quads, mesh.triangles, domain.fixed};
  patch.positions.resize(domain.fixed);
  patch.positions.insert(patch.positions.end(), domain.seams.begin(), domain.seams.end());
  const auto first = static_cast<std::int32_t>(patch.positions.size() - borders);
  for (std::size_t v = borders; v < mesh.row.size(); ++v)
    patch.positions.push_back(chart.at(rows.u[static_cast<std::size_t>(mesh.row[v])], mesh.theta[v]));
  const auto rename = [&](std::int32_t& v) {
    const auto k = static_cast<std::size_t>(v), n = domain.a.points.size();
    v = k < n ? domain.a.points[k].vertex : k < borders ? domain.b.points[k - n].vertex : v + first;
  };
  for (Quad& q : patch.quads) std::for_each(q.begin(), q.end(), rename);
  for (Triangle& t : patch.triangles) std::for_each(t.begin(), t.end(), rename);
  return patch;
}

// What mirroring does to the points of a border; none when it does not map onto itself.
std::optional<LoopReflection> reflection_of(const TubeBorder& border, const PatchMirror& borders) {
  std::vector<std::int32_t> loop, images;
  for (const TubeBorderPoint& point : border.points) {
    if (static_cast<std::size_t>(point.vertex) >= borders.image.size()) return std::nullopt;
    loop.push_back(point.vertex);
    images.push_back(borders.image[static_cast<std::size_t>(point.vertex)]);
  }
  return loop_reflection(loop, images);
}

// Rows that let the counts meet: stacks need room, and columns between them that go through.
int least_rows(std::size_t n, std::size_t m) {
  if (n == m) return 2;
  const std::size_t diamonds = (std::max(n, m) - std::min(n, m) + 1) / 2, through = std::min(n, m);
  return 2 + std::clamp(static_cast<int>((diamonds + through - 1) / through), 1, TubeOptions().deepest);
}

}  // namespace

std::optional<QuadTube> QuadTube::make(const TubeDomain& domain, std::string& fault) {
  auto chart = TubeChart::make(domain.patch, domain.a.loop, domain.b.loop);
  if (!chart) {
    fault = "the blended surface has no coordinates of a tube";
    return std::nullopt;
  }
  QuadTube tube(domain, *std::move(chart));
  const std::vector<double> angles = corner_sums(domain.patch);
  tube.side_a_ = side_of(domain.a, tube.chart_.theta_a(), angles);
  tube.side_b_ = side_of(domain.b, tube.chart_.theta_b(), angles);
  tube.lengths_ = tube.chart_.lengths(kSamples);
  const double rows = rows_until(tube.lengths_, domain.a.depth, domain.b.depth).back();
  tube.wanted_rows_ = std::max(least_rows(domain.a.points.size(), domain.b.points.size()),
                               static_cast<int>(std::lround(rows)));
  return tube;
}

std::optional<TubeTable> QuadTube::table(int rows, const TubeOptions& options) const {
  if (rows < 2) return std::nullopt;
  return solve_tube(side_a_, side_b_, rows, options);
}

std::optional<TubeTable> QuadTube::symmetric_table(int rows, const TubeOptions& options,
                                                   const PatchMirror& borders) const {
  if (rows < 2) return std::nullopt;
  const auto a = reflection_of(domain_->a, borders), b = reflection_of(domain_->b, borders);
  if (!a || !b) return std::nullopt;
  return solve_symmetric_tube(side_a_, *a, side_b_, *b, rows, options);
}

QuadPatch QuadTube::laid(const TubeTable& table, int rows) const {
  const Rows laid = lay_rows(lengths_, domain_->a.depth, domain_->b.depth, rows);
  return lifted(mesh_of(table, side_a_, side_b_, laid.share), chart_, laid, *domain_);
}

}  // namespace skinforge
