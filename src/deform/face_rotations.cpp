#include "deform/face_rotations.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace skinforge {
namespace {

using Mat4 = Eigen::Matrix4d;

constexpr std::size_t kChunk = 2048;  // ours: faces a task
constexpr double kSmallGap = 1e-3;    // ours: below it eigenvectors lose digits that Newton's way cannot keep
constexpr double kTie = 1e-12;        // ours: eigenvalues of a unit trace that rounding cannot tell apart

std::size_t heaviest(std::span<const WeightedRotation> rotations) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < rotations.size(); ++i)
    if (rotations[i].weight > rotations[best].weight) best = i;
  return best;
}

// The average lies in the plane of the two: a two by two eigenproblem.
Quat average_of_two(const WeightedRotation& a, const WeightedRotation& b) {
  const double cosine = a.rotation.dot(b.rotation), difference = a.weight - b.weight;
  const double root = std::hypot(difference, 2 * std::sqrt(a.weight * b.weight) * cosine);
  if (root < kTie * (a.weight + b.weight)) return difference < 0 ? b.rotation : a.rotation;
  const double of_larger = (std::abs(difference) + root) / 2;  // largest eigenvalue less the smaller weight
  const Vec4 mixed = difference >= 0
                         ? Vec4(of_larger * a.rotation.coeffs() + b.weight * cosine * b.rotation.coeffs())
                         : Vec4(a.weight * cosine * a.rotation.coeffs() + of_larger * b.rotation.coeffs());
  return Quat(mixed).normalized();
}

// Largest root of the characteristic polynomial, by Newton steps that fall towards it from `bound`.
double largest_eigenvalue(const Mat4& m, double bound) {
  const Mat4 m2 = m * m;
  const double t1 = m.trace(), t2 = m2.trace(), t3 = m2.cwiseProduct(m).sum(), t4 = m2.squaredNorm();
  const double c2 = (t1 * t1 - t2) / 2, c1 = (t1 * t1 * t1 - 3 * t1 * t2 + 2 * t3) / 6;
  const double c0 = (t1 * t1 * t1 * t1 - 6 * t1 * t1 * t2 + 3 * t2 * t2 + 8 * t1 * t3 - 6 * t4) /
                    24;  // Newton's identities
  double x = bound;
  for (int step = 0; step < 60; ++step) {
    const double value = (((x - t1) * x + c2) * x - c1) * x + c0;
    const double slope = ((4 * x - 3 * t1) * x + 2 * c2) * x - c1;
    if (slope <= 0) break;
    const double next = x - value / slope;
    if (!(next < x)) break;
    x = next;
  }
  return x;
}

// A column of the adjugate, by Cayley and Hamilton, where its diagonal is largest: for a matrix with one
// eigenvalue 0 a multiple of its eigenvector, of a length that shows the gaps to the other eigenvalues.
Vec4 adjugate_column(const Mat4& s) {
  const Mat4 s2 = s * s;
  const Vec4 diagonal3 = s2.cwiseProduct(s).rowwise().sum();
  const double t1 = s.trace(), t2 = s2.trace(), t3 = diagonal3.sum();
  const double c2 = (t1 * t1 - t2) / 2, c3 = (t1 * t1 * t1 - 3 * t1 * t2 + 2 * t3) / 6;
  const Vec4 diagonal = Vec4::Constant(c3) - c2 * s.diagonal() + t1 * s2.diagonal() - diagonal3;
  Eigen::Index column = 0;
  diagonal.cwiseAbs().maxCoeff(&column);
  return c3 * Vec4::Unit(column) - c2 * s.col(column) + t1 * s2.col(column) - s2 * s.col(column);
}

Quat average_of_many(std::span<const WeightedRotation> rotations) {
  Mat4 m = Mat4::Zero();
  double positive = 0;  // no eigenvalue is larger than the sum of the positive weights
  for (const WeightedRotation& r : rotations) {
    m += r.weight * r.rotation.coeffs() * r.rotation.coeffs().transpose();
    positive += std::max(r.weight, 0.0);
  }
  if (!(positive > 0)) return rotations[heaviest(rotations)].rotation;
  m /= positive;
  Mat4 shifted = m;
  shifted.diagonal().array() -= largest_eigenvalue(m, 1);
  const Vec4 vector = adjugate_column(shifted);
  if (vector.norm() > kSmallGap) return Quat(vector).normalized();
  const Eigen::SelfAdjointEigenSolver<Mat4> solver(m);
  if (solver.eigenvalues()[3] - solver.eigenvalues()[2] < kTie)
    return rotations[heaviest(rotations)].rotation;
  return Quat(Vec4(solver.eigenvectors().col(3)));
}

}  // namespace

Quat average_rotation(std::span<const WeightedRotation> rotations) {
  if (rotations.empty()) return Quat::Identity();
  if (rotations.size() == 1) return rotations[0].rotation;
  const bool is_positive =
      std::all_of(rotations.begin(), rotations.end(), [](const auto& r) { return r.weight >= 0; });
  if (rotations.size() == 2 && is_positive) return average_of_two(rotations[0], rotations[1]);
  return average_of_many(rotations);
}

FaceBlend::FaceBlend(std::span<const VertexTriangle> triangles, const SkinWeights& weights) {
  std::vector<Influence> row;
  for (const VertexTriangle& t : triangles) {
    row.clear();
    for (const VertexId v : t)
      for (const Influence& influence : weights.of(v)) row.push_back({influence.joint, influence.weight / 3});
    std::stable_sort(row.begin(), row.end(),
                     [](const Influence& a, const Influence& b) { return a.joint < b.joint; });
    std::size_t size = 0;
    for (const Influence& influence : row) {
      if (size > 0 && row[size - 1].joint == influence.joint)
        row[size - 1].weight += influence.weight;
      else
        row[size++] = influence;
    }
    row.resize(size);
    std::erase_if(row, [](const Influence& influence) { return influence.weight <= 0; });
    rows_.push_row(row);
  }
}

std::vector<Quat> FaceBlend::rotations(std::span<const Quat> bones) const {
  std::vector<Quat> all(face_count());
  parallel_chunks(all.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<WeightedRotation> terms;
    for (std::size_t f = begin; f < end; ++f) {
      terms.clear();
      for (const Influence& influence : rows_.of(VertexId(f)))
        terms.push_back({bones[influence.joint.index()], influence.weight});
      all[f] = average_rotation(terms);
    }
  });
  return all;
}

}  // namespace skinforge
