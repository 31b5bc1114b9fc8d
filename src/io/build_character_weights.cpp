#include "io/build_character_weights.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace skinforge {
namespace {

constexpr double kSumRounding = 1e-3;     // ours: four floats, or four 8-bit weights, that were normal
constexpr double kWeightRounding = 0.01;  // two to three steps of an 8-bit weight

struct Counts {
  std::size_t not_a_number = 0, negative = 0, sum = 0, repeated = 0;
};

WeightRow usable_row(const RawScene::Primitive& p, const std::vector<JointId>& joints, std::size_t v,
                     Counts& counts) {
  WeightRow row;
  double sum = 0;
  bool had_nan = false, had_negative = false;
  for (auto w = static_cast<std::size_t>(p.weight_begin[v]);
       w < static_cast<std::size_t>(p.weight_begin[v + 1]); ++w) {
    const double value = p.weight_value[w];
    had_nan |= !std::isfinite(value);
    had_negative |= value < 0;
    if (!(value > 0) || !std::isfinite(value)) continue;
    row.push_back({joints[static_cast<std::size_t>(p.weight_joint[w])], value});
    sum += value;
  }
  counts.not_a_number += had_nan;
  counts.negative += had_negative;
  if (row.empty()) return row;
  counts.sum += std::abs(sum - 1) > kSumRounding;
  const std::size_t stored = row.size();
  row = normalised_row(std::move(row));
  counts.repeated += row.size() < stored;
  return row;
}

double weight_in(const WeightRow& row, JointId joint) {
  for (const Influence& i : row)
    if (i.joint == joint) return i.weight;
  return 0;
}

bool is_covered(const WeightRow& a, const WeightRow& b) {
  for (const Influence& i : a)
    if (std::abs(i.weight - weight_in(b, i.joint)) > kWeightRounding) return false;
  return true;
}

/// Smallest vertex of each vertex's connected piece.
std::vector<std::size_t> pieces(const PolygonMesh& mesh) {
  std::vector<std::size_t> parent(mesh.vertex_count());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(FaceId(f));
    for (const VertexId v : face) {
      const std::size_t a = find(face.front().index()), b = find(v.index());
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = find(v);
  return parent;
}

}  // namespace

std::vector<WeightRow> weight_rows(const RawScene::Primitive& primitive, const std::vector<JointId>& joints,
                                   const std::string& place, IssueSink& issues) {
  Counts counts;
  std::vector<WeightRow> rows;
  for (std::size_t v = 0; v < primitive.positions.size(); ++v)
    rows.push_back(usable_row(primitive, joints, v, counts));
  if (counts.not_a_number > 0)
    issues.warn("weights-not-finite", place,
                fmt::format("{} of {} vertices had weights that are no numbers; those are dropped",
                            counts.not_a_number, rows.size()));
  if (counts.negative > 0)
    issues.warn("weights-negative", place,
                fmt::format("{} of {} vertices had negative weights; those are dropped", counts.negative,
                            rows.size()));
  if (counts.sum > 0)
    issues.warn(
        "weights-normalised", place,
        fmt::format("the weights of {} of {} vertices did not sum to 1; scaled", counts.sum, rows.size()));
  if (counts.repeated > 0)
    issues.warn("weights-merged", place,
                fmt::format("{} of {} vertices had several weights for one joint; added up", counts.repeated,
                            rows.size()));
  return rows;
}

bool is_same_row(const WeightRow& a, const WeightRow& b) {
  return a.empty() || b.empty() || (is_covered(a, b) && is_covered(b, a));
}

void fill_empty_rows(const PolygonMesh& mesh, std::vector<WeightRow>& rows, const std::string& place,
                     IssueSink& issues) {
  std::vector<std::size_t> given, empty;
  for (std::size_t v = 0; v < rows.size(); ++v) (rows[v].empty() ? empty : given).push_back(v);
  if (empty.empty()) return;
  const std::vector<std::size_t> piece = pieces(mesh);
  std::size_t from_piece = 0, from_mesh = 0;
  for (const std::size_t v : empty) {
    std::size_t best = rows.size(), best_here = rows.size();
    double distance = std::numeric_limits<double>::infinity(), distance_here = distance;
    for (const std::size_t g : given) {
      const double d = (mesh.positions[v] - mesh.positions[g]).squaredNorm();
      if (d < distance) distance = d, best = g;
      if (piece[g] == piece[v] && d < distance_here) distance_here = d, best_here = g;
    }
    if (best_here < rows.size())
      best = best_here, ++from_piece;
    else if (best < rows.size())
      ++from_mesh;
    rows[v] = best < rows.size() ? rows[best] : WeightRow{{JointId(0), 1.0}};
  }
  issues.warn(
      "weights-filled", place,
      fmt::format("{} vertices had no usable weight: {} take those of the nearest vertex in their piece, {} "
                  "of the nearest in the mesh, {} hang on the root",
                  empty.size(), from_piece, from_mesh, empty.size() - from_piece - from_mesh));
}

}  // namespace skinforge
