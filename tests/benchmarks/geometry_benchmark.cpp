#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "base/parallel.h"
#include "field/signed_distance.h"
#include "field/source_distance.h"
#include "geometry/quad_pairing.h"
#include "geometry/triangle_bvh.h"
#include "testing/shapes.h"

/// Kernels of geometry and field on torus knots: 5k and 50k triangles, one thread.
namespace skinforge {
namespace {

using testing::Soup;

Soup knot_of(std::int64_t triangles) {
  const int around = triangles > 20000 ? 30 : 10;
  return testing::torus_knot_soup(static_cast<int>(triangles) / (2 * around), around);
}

Eigen::AlignedBox3d box_of(const Soup& s) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : s.positions) box.extend(p);
  return box;
}

std::vector<Vec3> points_in_box(const Soup& s, std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const Eigen::AlignedBox3d box = box_of(s);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(box.min() + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(box.sizes()));
  return points;
}

// Points within a hundredth of the box of the surface.
std::vector<Vec3> points_near(const Soup& s, std::size_t count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-0.005, 0.005);
  const double size = box_of(s).diagonal().norm();
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(s.positions[random() % s.positions.size()] +
                     size * Vec3(unit(random), unit(random), unit(random)));
  return points;
}

void bvh_build(benchmark::State& state) {
  const Soup s = knot_of(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(TriangleBvh(s.positions, s.triangles));
}

template <class Points, class Query>
void ask(benchmark::State& state, const Points& points_of, const Query& query) {
  const Soup s = knot_of(state.range(0));
  const TriangleBvh bvh(s.positions, s.triangles);
  const std::vector<Vec3> points = points_of(s, 4096);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(query(bvh, points[i++ % points.size()]));
}

double winding(const TriangleBvh& bvh, const Vec3& p) {
  return bvh.winding_number(p);
}
double closest(const TriangleBvh& bvh, const Vec3& p) {
  return bvh.closest(p).distance;
}

void winding_in_box(benchmark::State& state) {
  ask(state, points_in_box, winding);
}
void winding_near(benchmark::State& state) {
  ask(state, points_near, winding);
}
void closest_in_box(benchmark::State& state) {
  ask(state, points_in_box, closest);
}
void closest_near(benchmark::State& state) {
  ask(state, points_near, closest);
}

// About `points` lattice points around the knot.
Lattice lattice_around(const Soup& s, double points) {
  const Eigen::AlignedBox3d box = box_of(s);
  Lattice lattice{.origin = box.min(), .voxel = std::cbrt(box.volume() / points), .size = {}};
  for (int axis = 0; axis < 3; ++axis)
    lattice.size[axis] = static_cast<std::int32_t>(box.sizes()[axis] / lattice.voxel) + 1;
  return lattice;
}

SourceSamples sample(const Soup& s, const TriangleBvh& bvh, const Lattice& lattice) {
  const std::vector<double> presence(s.positions.size(), 0.5);
  return sample_source(lattice, bvh, s.triangles, presence, 30);
}

void sample_lattice(benchmark::State& state) {
  set_thread_limit(1);
  const Soup s = knot_of(4000);
  const TriangleBvh bvh(s.positions, s.triangles);
  const Lattice lattice = lattice_around(s, static_cast<double>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(sample(s, bvh, lattice));
  state.counters["points"] = static_cast<double>(lattice.count());
}

void iso_surface(benchmark::State& state) {
  set_thread_limit(1);
  const Soup s = knot_of(4000);
  const Lattice lattice = lattice_around(s, static_cast<double>(state.range(0)));
  const DistanceField field{lattice, sample(s, TriangleBvh(s.positions, s.triangles), lattice).distance};
  std::size_t triangles = 0;
  for (auto _ : state) triangles = extract_iso_surface(field).triangles.size();
  state.counters["triangles"] = static_cast<double>(triangles);
}

void quads(benchmark::State& state) {
  const PolygonMesh mesh = testing::polygon_mesh(knot_of(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(recover_quads(mesh));
}

BENCHMARK(bvh_build)->Arg(5000)->Arg(50160)->Unit(benchmark::kMillisecond);
BENCHMARK(winding_in_box)->Arg(5000)->Arg(50160)->Unit(benchmark::kMicrosecond);
BENCHMARK(winding_near)->Arg(5000)->Arg(50160)->Unit(benchmark::kMicrosecond);
BENCHMARK(closest_in_box)->Arg(5000)->Arg(50160)->Unit(benchmark::kMicrosecond);
BENCHMARK(closest_near)->Arg(5000)->Arg(50160)->Unit(benchmark::kMicrosecond);
BENCHMARK(sample_lattice)->Arg(150000)->Unit(benchmark::kMillisecond);
BENCHMARK(iso_surface)->Arg(150000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(quads)->Arg(5000)->Arg(50160)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skinforge
