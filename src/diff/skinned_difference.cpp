#include "diff/skinned_difference.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "skinning/linear_blend.h"

namespace skinforge {

namespace {
constexpr std::size_t kChunk = 64;      // ours: vertices a bound; fewer cost more bounds than they save
constexpr double kRounding = 1 + 1e-9;  // ours: far above what the sums of a bound lose

Vec4 homogeneous(const Vec3& p) {
  return {p.x(), p.y(), p.z(), 1};
}

// At least the largest singular value: equal to it for rotations with one scale (Gershgorin of L^T L).
double largest_scale(const Mat3& linear) {
  const Mat3 square = linear.transpose() * linear;
  return std::sqrt(square.cwiseAbs().rowwise().sum().maxCoeff());
}
}  // namespace

// Maps: P_j - Q_j for each joint of A (P_j where it has no image), one for vertices without weights; then Q_k
// for each joint of B, and one more likewise.
SkinnedDifference::SkinnedDifference(const Character& a, const Character& b, const Correspondence& same)
    : a_(a), b_(b), image_(same.joints) {
  for (std::size_t v = 0; v < same.vertices.size(); ++v)
    if (same.vertices[v].is_valid()) order_.push_back({VertexId(v), same.vertices[v]});
  add_products();
  add_chunks();
}

std::vector<SkinnedDifference::Term> SkinnedDifference::moved_terms(const Pair& pair) const {
  const Vec4 at = homogeneous(a_.mesh.positions[pair.a.index()]);
  std::vector<Term> terms;
  for (const Influence& i : a_.weights.of(pair.a))
    if (i.weight != 0) terms.push_back({i.joint.index(), i.weight * at});
  if (a_.weights.of(pair.a).empty()) terms.push_back({image_.size(), at});
  std::sort(terms.begin(), terms.end(), [](const Term& x, const Term& y) { return x.map < y.map; });
  return terms;
}

std::vector<SkinnedDifference::Term> SkinnedDifference::rest_terms(const Pair& pair) const {
  const std::size_t first = image_.size() + 1;
  std::map<std::size_t, Vec4> sums;
  const auto add = [&](std::size_t joint, const Vec4& vector) {
    sums.try_emplace(first + joint, Vec4::Zero()).first->second += vector;
  };
  for (const Term& term : moved_terms(pair)) {
    const bool is_still = term.map == image_.size();
    if (is_still || image_[term.map].is_valid())
      add(is_still ? b_.skeleton.size() : image_[term.map].index(), term.vector);
  }
  const Vec4 at = homogeneous(b_.mesh.positions[pair.b.index()]);
  for (const Influence& i : b_.weights.of(pair.b)) add(i.joint.index(), -i.weight * at);
  if (b_.weights.of(pair.b).empty()) add(b_.skeleton.size(), -at);
  std::vector<Term> terms;
  for (const auto& [map, vector] : sums)
    if (!vector.isZero(0)) terms.push_back({map, vector});
  return terms;
}

void SkinnedDifference::add_products() {
  std::map<std::pair<std::size_t, std::size_t>, Eigen::Matrix4d> sums;
  for (const Pair& pair : order_) {
    std::vector<Term> terms = moved_terms(pair);
    for (Term& rest : rest_terms(pair)) terms.push_back(std::move(rest));
    for (std::size_t i = 0; i < terms.size(); ++i)
      for (std::size_t k = i; k < terms.size(); ++k)
        sums.try_emplace({terms[i].map, terms[k].map}, Eigen::Matrix4d::Zero()).first->second +=
            terms[i].vector * terms[k].vector.transpose();
  }
  for (const auto& [maps, sum] : sums) products_.push_back({maps.first, maps.second, sum});
}

void SkinnedDifference::add_chunks() {
  std::map<std::vector<std::size_t>, std::vector<Pair>> groups;
  for (const Pair& pair : order_) {
    std::vector<std::size_t> maps;
    for (const Term& term : moved_terms(pair)) maps.push_back(term.map);
    groups[std::move(maps)].push_back(pair);
  }
  order_.clear();
  for (const auto& [maps, pairs] : groups) {
    const std::size_t begin = order_.size();
    order_.insert(order_.end(), pairs.begin(), pairs.end());
    split(begin, order_.size(), maps);
  }
}

// Halves along the longest side until few are left.
void SkinnedDifference::split(std::size_t begin, std::size_t end, const std::vector<std::size_t>& moved) {
  if (end - begin <= kChunk) return add_chunk(begin, end, moved);
  const auto position = [&](const Pair& pair) -> const Vec3& { return a_.mesh.positions[pair.a.index()]; };
  Vec3 least = position(order_[begin]), most = least;
  for (std::size_t i = begin; i < end; ++i) {
    least = least.cwiseMin(position(order_[i]));
    most = most.cwiseMax(position(order_[i]));
  }
  Eigen::Index axis = 0;
  (most - least).maxCoeff(&axis);
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(at(begin), at(middle), at(end), [&](const Pair& x, const Pair& y) {
    const double of_x = position(x)[axis], of_y = position(y)[axis];
    return of_x != of_y ? of_x < of_y : x.a < y.a;
  });
  split(begin, middle, moved);
  split(middle, end, moved);
}

void SkinnedDifference::add_chunk(std::size_t begin, std::size_t end, const std::vector<std::size_t>& moved) {
  Chunk chunk;
  chunk.begin = begin;
  chunk.end = end;
  chunk.moved = moved;
  Vec3 least = a_.mesh.positions[order_[begin].a.index()], most = least;
  for (std::size_t i = begin; i < end; ++i) {
    const Vec3& p = a_.mesh.positions[order_[i].a.index()];
    least = least.cwiseMin(p);
    most = most.cwiseMax(p);
  }
  chunk.center = (least + most) / 2;
  chunk.half = (most - least) / 2;
  std::map<std::size_t, Rest> rests;
  for (std::size_t i = begin; i < end; ++i) {
    double weight = 0, imbalance = 0;
    for (const Term& term : moved_terms(order_[i])) weight += std::abs(term.vector.w());
    chunk.weight = std::max(chunk.weight, weight);
    for (const Term& term : rest_terms(order_[i])) {
      Rest& rest = rests.try_emplace(term.map, Rest{term.map, 0, 0}).first->second;
      rest.spread = std::max(rest.spread, (term.vector.head<3>() - term.vector.w() * chunk.center).norm());
      rest.weight = std::max(rest.weight, std::abs(term.vector.w()));
      imbalance += term.vector.w();
    }
    chunk.imbalance = std::max(chunk.imbalance, std::abs(imbalance));
  }
  for (const auto& [map, rest] : rests) chunk.rests.push_back(rest);
  chunks_.push_back(std::move(chunk));
}

SkinnedDifference::Frame::Frame(const SkinnedDifference& model, std::span<const Affine3> of_a,
                                std::span<const Affine3> of_b)
    : model_(model), of_a_(of_a), of_b_(of_b) {
  const auto rows = [](const Affine3& m) -> Matrix34 { return m.matrix(); };
  for (std::size_t j = 0; j < of_a.size(); ++j) {
    const JointId image = model.image_[j];
    maps_.push_back(image.is_valid() ? Matrix34(rows(of_a[j]) - rows(of_b[image.index()])) : rows(of_a[j]));
  }
  maps_.push_back(Matrix34::Zero());
  for (const Affine3& m : of_b) maps_.push_back(rows(m));
  maps_.push_back(Matrix34::Identity());
  for (const Matrix34& m : maps_) {
    column_lengths_.push_back(m.leftCols<3>().colwise().norm().transpose());
    largest_scale_.push_back(largest_scale(m.leftCols<3>()));
  }
}

double SkinnedDifference::Frame::sum_of_squares() const {
  double sum = 0;
  for (const Product& product : model_.products_) {
    const Matrix34 first = maps_[product.first] * product.sum;
    const double share = first.cwiseProduct(maps_[product.second]).sum();
    sum += product.first == product.second ? share : 2 * share;
  }
  return std::max(sum, 0.0);
}

double SkinnedDifference::Frame::bound(std::size_t index) const {
  const Chunk& chunk = model_.chunks_[index];
  const Vec4 center = homogeneous(chunk.center);
  double moved = 0;
  for (const std::size_t map : chunk.moved)
    moved = std::max(moved, (maps_[map] * center).norm() + column_lengths_[map].dot(chunk.half));
  double length = chunk.weight * moved;
  if (chunk.rests.empty()) return length * kRounding;
  const Vec3 reference = maps_[chunk.rests.front().map] * center;
  for (const Rest& rest : chunk.rests)
    length +=
        largest_scale_[rest.map] * rest.spread + rest.weight * (maps_[rest.map] * center - reference).norm();
  return (length + chunk.imbalance * reference.norm()) * kRounding;
}

double SkinnedDifference::Frame::square_of(std::size_t index) const {
  const Pair& pair = model_.order_[index];
  const auto posed = [](const Character& c, VertexId v, std::span<const Affine3> palette) -> Vec3 {
    const Matrix34 m = blended_map(c.weights.of(v), palette).matrix();
    return m.leftCols<3>() * c.mesh.positions[v.index()] + m.col(3);
  };
  return (posed(model_.a_, pair.a, of_a_) - posed(model_.b_, pair.b, of_b_)).squaredNorm();
}

std::optional<SkinnedDifference::Distance> SkinnedDifference::Frame::largest_above(double least) const {
  std::optional<Distance> best;
  for (std::size_t c = 0; c < model_.chunks_.size(); ++c) {
    const double length = bound(c);
    if (length * length <= least) continue;
    for (std::size_t i = model_.chunks_[c].begin; i < model_.chunks_[c].end; ++i) {
      const double square = square_of(i);
      if (!(square > least)) continue;
      const VertexId vertex = model_.order_[i].a;
      const bool is_first = best && square == best->square && vertex < best->vertex;
      if (!best || square > best->square || is_first) best = {square, vertex};
    }
  }
  return best;
}

}  // namespace skinforge
