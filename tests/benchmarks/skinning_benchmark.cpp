#include <benchmark/benchmark.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <map>
#include <memory>

#include "base/parallel.h"
#include "deform/dual_quaternion_blend.h"
#include "deform/face_rotations.h"
#include "deform/poisson_stitch.h"
#include "skeleton/rotations.h"
#include "skinning/harmonic_weights.h"
#include "skinning/linear_blend.h"
#include "testing/course.h"
#include "testing/shapes.h"

/// Kernels of the skinning toolkit, one and two threads, on a closed tube with a chain of 20 bones (5k, 20k
/// and 200k vertices), and on the course's hand (4780) and human (18453) where the shared folder has them.
/// `Plain` are the same results the way the course's helper library makes them: dense columns of weights,
/// sparse matrices from triplets, one 4 x 4 eigenproblem a face, one back-solve a coordinate.
namespace skinforge {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
constexpr int kTubeBones = 20;
constexpr int kHand = 4780, kHuman = 18453;  // vertices of the course's meshes, by which they are asked for

/// A knotted tube, its bones' handles (a band of each bone's stretch) and a pose.
struct Scene {
  std::vector<Vec3> positions;
  std::vector<VertexTriangle> triangles;
  Handles handles;
  SkinWeights weights;
  Eigen::MatrixXd dense;
  std::vector<RigidMotion> motions;
  std::vector<Affine3> palette;
  std::vector<Quat> rotations;
  std::vector<VertexId> held;
  std::vector<Mat3> maps;

  explicit Scene(std::int64_t which) {
    if (which == kHand || which == kHuman)
      load_course(which == kHand ? "hand_sequence" : "human", which == kHand ? 33 : 80);
    else
      make_tube(static_cast<int>(which));
    weights = harmonic_weights(positions, triangles, handles).weights;
    dense = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(positions.size()), bones());
    for (std::size_t v = 0; v < positions.size(); ++v)
      for (const Influence& w : weights.of(VertexId(v)))
        dense(static_cast<Eigen::Index>(v), w.joint.value) = w.weight;
    for (const RigidMotion& motion : motions) {
      palette.push_back(motion.matrix());
      rotations.push_back(motion.rotation);
    }
    for (const Quat& q : FaceBlend(triangles, weights).rotations(rotations))
      maps.push_back(q.toRotationMatrix());
  }
  int bones() const { return static_cast<int>(motions.size()); }

  void make_tube(int vertices) {
    const int around = vertices > 50000 ? 100 : vertices > 10000 ? 40 : 20, along = vertices / around;
    const testing::Soup soup = testing::torus_knot_soup(along, around);
    positions = soup.positions;
    for (const auto& t : soup.triangles)
      triangles.push_back({VertexId(t[0]), VertexId(t[1]), VertexId(t[2])});
    handles.resize(positions.size());
    for (int i = 0; i < along; ++i) {
      const double place = static_cast<double>(i) * kTubeBones / along;  // half of each stretch is held
      if (place - std::floor(place) < 0.5)
        for (int j = 0; j < around; ++j)
          handles[static_cast<std::size_t>(i * around + j)] = JointId(static_cast<int>(place));
    }
    hold(JointId(0));
    for (int k = 0; k < kTubeBones; ++k)
      motions.push_back({from_rotation_vector(0.4 * Vec3(std::sin(k), std::cos(2 * k), std::sin(3 * k))),
                         0.1 * Vec3(k % 3, k % 5, k % 7)});
  }

  void load_course(const std::string& name, std::size_t frame) {
    const testing::CourseCase course(name);
    positions = course.mesh.positions;
    triangles = course.triangles;
    handles = course.handles;
    hold(JointId(course.root_bone));
    motions = forward_kinematics(course.forest, course.frames.frames[frame]);
  }

  void hold(JointId joint) {
    for (std::size_t v = 0; v < handles.size(); ++v)
      if (handles[v] == joint) held.emplace_back(v);
  }
  static const Scene& of(std::int64_t vertices) {
    static std::map<std::int64_t, std::unique_ptr<Scene>> scenes;
    auto& scene = scenes[vertices];
    if (!scene) scene = std::make_unique<Scene>(vertices);
    return *scene;
  }
};

void use_threads(const benchmark::State& state) {
  set_thread_limit(static_cast<std::size_t>(state.range(1)));
}

// The Laplacian over all vertices, from triplets.
Matrix plain_laplacian(const Scene& scene) {
  std::vector<Eigen::Triplet<double>> entries;
  const CotangentWeights weights = cotangent_weights(scene.positions, scene.triangles);
  for (std::size_t f = 0; f < scene.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = scene.triangles[f][(k + 1) % 3].value, b = scene.triangles[f][(k + 2) % 3].value;
      const double w = weights.half_cotangents[f][k];
      entries.emplace_back(a, a, w), entries.emplace_back(b, b, w);
      entries.emplace_back(a, b, -w), entries.emplace_back(b, a, -w);
    }
  const auto n = static_cast<Eigen::Index>(scene.positions.size());
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Rows and columns of free vertices, and what the held ones give to them.
struct PlainSystem {
  std::vector<Eigen::Index> free;
  std::vector<int> row;
  Matrix free_block, held_block;
};
PlainSystem plain_system(const Matrix& matrix, const std::vector<bool>& is_held) {
  PlainSystem system;
  system.row.assign(is_held.size(), -1);
  for (std::size_t v = 0; v < is_held.size(); ++v)
    if (!is_held[v]) {
      system.row[v] = static_cast<int>(system.free.size());
      system.free.push_back(static_cast<Eigen::Index>(v));
    }
  std::vector<Eigen::Triplet<double>> inner, outer;
  for (int c = 0; c < matrix.outerSize(); ++c)
    for (Matrix::InnerIterator it(matrix, c); it; ++it) {
      const int r = system.row[static_cast<std::size_t>(it.row())],
                j = system.row[static_cast<std::size_t>(c)];
      if (r < 0) continue;
      if (j >= 0)
        inner.emplace_back(r, j, it.value());
      else
        outer.emplace_back(r, c, it.value());
    }
  const auto n = static_cast<Eigen::Index>(system.free.size());
  system.free_block.resize(n, n);
  system.free_block.setFromTriplets(inner.begin(), inner.end());
  system.held_block.resize(n, matrix.cols());
  system.held_block.setFromTriplets(outer.begin(), outer.end());
  return system;
}

void plain_harmonic(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  for (auto _ : state) {
    std::vector<bool> is_held;
    Eigen::MatrixXd given = Eigen::MatrixXd::Zero(scene.dense.rows(), scene.bones());
    for (std::size_t v = 0; v < scene.handles.size(); ++v) {
      is_held.push_back(scene.handles[v].is_valid());
      if (is_held.back()) given(static_cast<Eigen::Index>(v), scene.handles[v].value) = 1;
    }
    const PlainSystem system = plain_system(plain_laplacian(scene), is_held);
    const Eigen::SimplicialLDLT<Matrix> factor(system.free_block);
    const Eigen::MatrixXd right = -(system.held_block * given);
    const Eigen::MatrixXd solution = factor.solve(right);
    benchmark::DoNotOptimize(solution.data());
    double worst = 0;
    for (std::size_t i = 0; i < system.free.size(); ++i)
      worst = std::max(worst, (solution.row(static_cast<Eigen::Index>(i)) - scene.dense.row(system.free[i]))
                                  .cwiseAbs()
                                  .maxCoeff());
    state.counters["difference"] = worst;
  }
}

void harmonic(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  use_threads(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(harmonic_weights(scene.positions, scene.triangles, scene.handles).least);
}

void plain_linear(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  Eigen::MatrixXd matrix(scene.dense.rows(), 4 * scene.bones()), transforms(4 * scene.bones(), 3);
  for (Eigen::Index v = 0; v < matrix.rows(); ++v)
    for (int k = 0; k < scene.bones(); ++k)
      matrix.block<1, 4>(v, 4 * k) =
          scene.dense(v, k) * scene.positions[static_cast<std::size_t>(v)].homogeneous().transpose();
  for (int k = 0; k < scene.bones(); ++k)
    transforms.block<4, 3>(4 * k, 0) = scene.palette[static_cast<std::size_t>(k)].matrix().transpose();
  for (auto _ : state) {
    const Eigen::MatrixXd posed = matrix * transforms;
    benchmark::DoNotOptimize(posed.data());
  }
}

void linear(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  use_threads(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(linear_blend(scene.positions, scene.weights, scene.palette).data());
}

void plain_dual(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  std::vector<DualQuat> bones;
  for (const RigidMotion& motion : scene.motions) bones.push_back(dual_quaternion(motion));
  for (auto _ : state) {
    Eigen::MatrixXd posed(scene.dense.rows(), 3);
    for (Eigen::Index v = 0; v < posed.rows(); ++v) {
      Vec4 real = Vec4::Zero(), dual = Vec4::Zero();
      for (int k = 0; k < scene.bones(); ++k) {
        const DualQuat& bone = bones[static_cast<std::size_t>(k)];
        const double w = bone.real.coeffs().dot(real) < 0 ? -scene.dense(v, k) : scene.dense(v, k);
        real += w * bone.real.coeffs();
        dual += w * bone.dual.coeffs();
      }
      posed.row(v) = rigid_motion({Quat(real), Quat(dual)}) * scene.positions[static_cast<std::size_t>(v)];
    }
    benchmark::DoNotOptimize(posed.data());
  }
}

void dual(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  use_threads(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(dual_quaternion_blend(scene.positions, scene.weights, scene.motions).data());
}

void plain_faces(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  for (auto _ : state) {
    std::vector<Mat3> maps;
    for (const VertexTriangle& t : scene.triangles) {
      Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
      for (int k = 0; k < scene.bones(); ++k) {
        const double h =
            (scene.dense(t[0].value, k) + scene.dense(t[1].value, k) + scene.dense(t[2].value, k)) / 3;
        const Vec4& q = scene.rotations[static_cast<std::size_t>(k)].coeffs();
        if (h > 0) sum += h * q * q.transpose();
      }
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
      maps.push_back(Quat(Vec4(solver.eigenvectors().col(3))).toRotationMatrix());
    }
    benchmark::DoNotOptimize(maps.data());
  }
}

void faces(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  use_threads(state);
  const FaceBlend blend(scene.triangles, scene.weights);
  for (auto _ : state) {
    std::vector<Mat3> maps;
    maps.reserve(scene.triangles.size());
    for (const Quat& q : blend.rotations(scene.rotations)) maps.push_back(q.toRotationMatrix());
    benchmark::DoNotOptimize(maps.data());
  }
}

// Gradient by faces: rows of one face below each other, d/dx, d/dy, d/dz.
Matrix plain_gradient(const Scene& scene, Eigen::VectorXd& areas) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto m = static_cast<Eigen::Index>(scene.triangles.size());
  areas.resize(3 * m);
  for (std::size_t f = 0; f < scene.triangles.size(); ++f) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = scene.positions[scene.triangles[f][k].index()];
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
    areas.segment<3>(static_cast<Eigen::Index>(3 * f)).setConstant(normal.norm() / 2);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 gradient = normal.cross(p[(k + 2) % 3] - p[(k + 1) % 3]) / normal.squaredNorm();
      for (int d = 0; d < 3; ++d)
        entries.emplace_back(static_cast<int>(3 * f) + d, scene.triangles[f][k].value, gradient[d]);
    }
  }
  Matrix gradient(3 * m, static_cast<Eigen::Index>(scene.positions.size()));
  gradient.setFromTriplets(entries.begin(), entries.end());
  return gradient;
}

void plain_poisson(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  Eigen::VectorXd areas;
  const Matrix gradient = plain_gradient(scene, areas);
  const Matrix divergence = gradient.transpose() * areas.asDiagonal();
  std::vector<bool> is_held(scene.positions.size(), false);
  for (const VertexId v : scene.held) is_held[v.index()] = true;
  const PlainSystem system = plain_system(divergence * gradient, is_held);
  const Eigen::SimplicialLDLT<Matrix> factor(system.free_block);
  const auto places = linear_blend(scene.positions, scene.weights, scene.palette);
  Eigen::MatrixXd given = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(places.size()), 3);
  for (const VertexId v : scene.held) given.row(v.value) = places[v.index()];
  const auto ours = PoissonStitcher(scene.positions, scene.triangles, scene.held).stitch(scene.maps, places);
  for (auto _ : state) {
    Eigen::MatrixXd blocks(static_cast<Eigen::Index>(3 * scene.maps.size()), 3);
    for (std::size_t f = 0; f < scene.maps.size(); ++f)
      blocks.block<3, 3>(static_cast<Eigen::Index>(3 * f), 0) = scene.maps[f].transpose();
    const Eigen::MatrixXd all = divergence * blocks;
    Eigen::MatrixXd right(static_cast<Eigen::Index>(system.free.size()), 3);
    for (std::size_t i = 0; i < system.free.size(); ++i)
      right.row(static_cast<Eigen::Index>(i)) = all.row(system.free[i]);
    right -= system.held_block * given;
    const Eigen::MatrixXd solution = factor.solve(right);
    benchmark::DoNotOptimize(solution.data());
    double worst = 0;
    for (std::size_t i = 0; i < system.free.size(); ++i)
      worst = std::max(worst, (solution.row(static_cast<Eigen::Index>(i)).transpose() -
                               ours[static_cast<std::size_t>(system.free[i])])
                                  .norm());
    state.counters["difference"] = worst;
  }
}

void poisson(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  use_threads(state);
  const PoissonStitcher stitcher(scene.positions, scene.triangles, scene.held);
  const auto places = linear_blend(scene.positions, scene.weights, scene.palette);
  for (auto _ : state) benchmark::DoNotOptimize(stitcher.stitch(scene.maps, places).data());
}

void poisson_factor(benchmark::State& state) {
  const Scene& scene = Scene::of(state.range(0));
  use_threads(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(PoissonStitcher(scene.positions, scene.triangles, scene.held).added());
}

std::vector<int> sizes() {
  std::vector<int> all{5000, 20000, 200000};
  if (std::filesystem::exists(testing::shared_file("assignment6"))) all.insert(all.begin(), {kHand, kHuman});
  return all;
}
void one_thread(benchmark::internal::Benchmark* b) {
  for (const int n : sizes()) b->Args({n, 1});
  b->Unit(benchmark::kMillisecond);
}
void both(benchmark::internal::Benchmark* b) {
  for (const int threads : {1, 2})
    for (const int n : sizes()) b->Args({n, threads});
  b->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

BENCHMARK(plain_harmonic)->Apply(one_thread)->Name("Skinning/Harmonic/Plain");
BENCHMARK(harmonic)->Apply(both)->Name("Skinning/Harmonic");
BENCHMARK(plain_linear)->Apply(one_thread)->Name("Skinning/Linear/Plain");
BENCHMARK(linear)->Apply(both)->Name("Skinning/Linear");
BENCHMARK(plain_dual)->Apply(one_thread)->Name("Skinning/Dual/Plain");
BENCHMARK(dual)->Apply(both)->Name("Skinning/Dual");
BENCHMARK(plain_faces)->Apply(one_thread)->Name("Skinning/Faces/Plain");
BENCHMARK(faces)->Apply(both)->Name("Skinning/Faces");
BENCHMARK(plain_poisson)->Apply(one_thread)->Name("Skinning/Poisson/Plain");
BENCHMARK(poisson)->Apply(both)->Name("Skinning/Poisson");
BENCHMARK(poisson_factor)->Apply(one_thread)->Name("Skinning/PoissonFactor");

}  // namespace
}  // namespace skinforge
