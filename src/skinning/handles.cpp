#include "skinning/handles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "base/expect.h"
#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr std::size_t kChunk = 512;

// Distance of each vertex to each joint that has segments.
class JointDistances {
 public:
  JointDistances(std::span<const Vec3> positions, std::span<const BoneSegment> segments) {
    for (const BoneSegment& s : segments)
      if (joints_.empty() || joints_.back() != s.joint) joints_.push_back(s.joint);
    distance_.assign(positions.size() * joints_.size(), std::numeric_limits<double>::infinity());
    parallel_chunks(positions.size(), kChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        std::size_t k = 0;
        for (const BoneSegment& s : segments) {
          while (joints_[k] != s.joint) ++k;
          double& d = distance_[v * joints_.size() + k];
          d = std::min(d, s.distance(positions[v]));
        }
      }
    });
  }
  std::size_t joint_count() const { return joints_.size(); }
  JointId joint(std::size_t k) const { return joints_[k]; }
  std::size_t vertex_count() const { return joints_.empty() ? 0 : distance_.size() / joints_.size(); }
  double operator()(std::size_t v, std::size_t k) const { return distance_[v * joints_.size() + k]; }

  double least(std::size_t k) const {
    double d = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < vertex_count(); ++v) d = std::min(d, (*this)(v, k));
    return d;
  }
  std::size_t nearest(std::size_t v) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < joints_.size(); ++k)
      if ((*this)(v, k) < (*this)(v, best)) best = k;
    return best;
  }

 private:
  std::vector<JointId> joints_;
  std::vector<double> distance_;  ///< [vertex][joint]
};

// The vertices that are nearest to joint k of all, the nearest first, at most `count`.
std::vector<std::size_t> nearest_of_own(const JointDistances& distances, std::size_t k, std::size_t count) {
  std::vector<std::size_t> own;
  for (std::size_t v = 0; v < distances.vertex_count(); ++v)
    if (distances.nearest(v) == k) own.push_back(v);
  std::stable_sort(own.begin(), own.end(),
                   [&](std::size_t a, std::size_t b) { return distances(a, k) < distances(b, k); });
  own.resize(std::min(own.size(), count));
  return own;
}

// The one value that all corners of a vertex have; `none` where they differ or there are none.
template <class Value>
std::vector<Value> agreed(const PolygonMesh& mesh, Value none,
                          const std::function<Value(std::size_t)>& of_corner) {
  std::vector<Value> value(mesh.vertex_count(), none);
  std::vector<bool> seen(mesh.vertex_count(), false);
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    const std::size_t v = mesh.corners[c].index();
    const Value here = of_corner(c);
    value[v] = !seen[v] || value[v] == here ? here : none;
    seen[v] = true;
  }
  return value;
}

}  // namespace

Handles handles_by_distance(std::span<const Vec3> positions, std::span<const BoneSegment> segments,
                            const HandleRule& rule) {
  SF_EXPECT(rule.factor >= 1);
  const JointDistances distances(positions, segments);
  Handles handles(positions.size());
  std::vector<double> reach;
  for (std::size_t k = 0; k < distances.joint_count(); ++k) reach.push_back(rule.factor * distances.least(k));
  std::vector<std::size_t> count(distances.joint_count(), 0);
  for (std::size_t v = 0; v < distances.vertex_count(); ++v) {
    std::size_t best = distances.joint_count();
    for (std::size_t k = 0; k < distances.joint_count(); ++k)
      if (distances(v, k) <= reach[k] &&
          (best == distances.joint_count() || distances(v, k) < distances(v, best)))
        best = k;
    if (best == distances.joint_count()) continue;
    handles[v] = distances.joint(best);
    ++count[best];
  }
  for (std::size_t k = 0; k < distances.joint_count(); ++k)
    if (count[k] < rule.at_least)
      for (const std::size_t v : nearest_of_own(distances, k, rule.at_least)) handles[v] = distances.joint(k);
  return handles;
}

Handles handles_of_weights(const SkinWeights& weights, double threshold) {
  Handles handles(weights.vertex_count());
  for (std::size_t v = 0; v < handles.size(); ++v)
    for (const Influence& influence : weights.of(VertexId(v)))
      if (influence.weight > threshold) {
        handles[v] = influence.joint;
        break;  // rows are sorted by falling weight
      }
  return handles;
}

Handles handles_of_groups(const PolygonMesh& mesh, const Skeleton& skeleton) {
  std::vector<JointId> joint_of_part;
  for (const MeshPart& part : mesh.parts)
    joint_of_part.push_back(skeleton.find(part.name).value_or(JointId()));
  if (std::none_of(joint_of_part.begin(), joint_of_part.end(), [](JointId j) { return j.is_valid(); }))
    throw Error(
        ExitCode::BadInput,
        fmt::format("no face group is named after a joint; the first group is \"{}\", the first joint \"{}\"",
                    mesh.parts.empty() ? "" : mesh.parts[0].name, skeleton.joints[0].name));
  std::vector<FaceId> face_of_corner(mesh.corner_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (std::size_t c = mesh.first_corner(FaceId(f)); c < mesh.first_corner(FaceId(f + 1)); ++c)
      face_of_corner[c] = FaceId(f);
  return agreed<JointId>(mesh, JointId(), [&](std::size_t c) {
    return joint_of_part[mesh.face_part[face_of_corner[c].index()].index()];
  });
}

Handles handles_of_image(const PolygonMesh& mesh, std::span<const LabelColor> labels, const Raster& image,
                         int tolerance) {
  if (mesh.uvs.empty())
    throw Error(ExitCode::BadInput, "the mesh has no UVs to look up a painted image with");
  SF_EXPECT(image.width > 0 && image.height > 0);
  const auto pixel = [](double t, int size) {
    const double inside = t - std::floor(t);
    return std::min(static_cast<int>(inside * size), size - 1);
  };
  const auto label_at = [&](std::size_t corner) {
    const Vec2& uv = mesh.uvs[0][corner];
    const int at = 4 * (pixel(uv.y(), image.height) * image.width + pixel(uv.x(), image.width));
    for (const LabelColor& label : labels) {
      bool is_same = true;
      for (int c = 0; c < 3; ++c)
        is_same = is_same && std::abs(image.rgba[static_cast<std::size_t>(at + c)] -
                                      label.color[static_cast<std::size_t>(c)]) <= tolerance;
      if (is_same) return label.joint;
    }
    return JointId();
  };
  return agreed<JointId>(mesh, JointId(), label_at);
}

std::vector<HandleCount> count_handles(const Handles& handles, std::size_t joint_count) {
  std::vector<HandleCount> counts;
  for (std::size_t j = 0; j < joint_count; ++j) counts.push_back({JointId(j), 0});
  for (const JointId joint : handles)
    if (joint.is_valid()) ++counts[joint.index()].vertices;
  return counts;
}

Handles handles_of_labels(const Eigen::MatrixXd& table, std::size_t vertices,
                          std::span<const JointId> joint_of_bone) {
  if (table.cols() != 1 || static_cast<std::size_t>(table.rows()) != vertices)
    throw Error(ExitCode::BadInput,
                fmt::format("{} x {} labels; the mesh has {} vertices, each with one label", table.rows(),
                            table.cols(), vertices));
  Handles handles(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const double label = table(static_cast<Eigen::Index>(v), 0);
    if (label != std::floor(label) || label < -1 || label >= static_cast<double>(joint_of_bone.size()))
      throw Error(ExitCode::BadInput,
                  fmt::format("label {} of vertex {}: labels are -1 (free) or a bone from 0 to {}", label, v,
                              joint_of_bone.size() - 1));
    if (label >= 0) handles[v] = joint_of_bone[static_cast<std::size_t>(label)];
  }
  return handles;
}

Eigen::MatrixXd label_table(const Handles& handles) {
  Eigen::MatrixXd table(static_cast<Eigen::Index>(handles.size()), 1);
  for (std::size_t v = 0; v < handles.size(); ++v) table(static_cast<Eigen::Index>(v), 0) = handles[v].value;
  return table;
}

}  // namespace skinforge
