#include "skinning/bone_segments.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/expect.h"
#include "base/parallel.h"

namespace skinforge {
namespace {

constexpr double kShort = 1e-6;  // ours: of the extent; two joints in one place
constexpr double kLeaf = 0.5;    // ours: a hand or head is about half as long as what leads to it
constexpr std::size_t kChunk = 512;

bool marks_an_end(const std::string& name) {
  std::string lower = name;
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::array<std::string_view, 4> kMarks{"_end", ".end", "nub", "_leaf"};
  return std::any_of(kMarks.begin(), kMarks.end(),
                     [&](std::string_view mark) { return lower.ends_with(mark); });
}

double extent_of(std::span<const Vec3> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

}  // namespace

Vec3 BoneSegment::closest(const Vec3& p) const {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm();
  if (length2 <= 0) return a;
  return a + std::clamp((p - a).dot(along) / length2, 0.0, 1.0) * along;
}

std::vector<BoneSegment> bone_segments(const Skeleton& skeleton) {
  std::vector<Vec3> place;
  for (const Affine3& joint : skeleton.model_from_joint()) place.push_back(joint.translation());
  const auto children = skeleton.children();
  const double too_short = kShort * extent_of(place);
  std::vector<BoneSegment> segments;
  for (std::size_t j = 0; j < skeleton.size(); ++j) {
    const std::size_t before = segments.size();
    for (const JointId child : children[j])
      if ((place[child.index()] - place[j]).norm() > too_short)
        segments.push_back({JointId(j), place[j], place[child.index()]});
    if (segments.size() > before) continue;
    const JointId parent = skeleton.joints[j].parent;
    const bool is_leaf = children[j].empty();
    if (is_leaf && parent.is_valid() && marks_an_end(skeleton.joints[j].name)) continue;
    const Vec3 tip =
        is_leaf && parent.is_valid() ? Vec3(place[j] + kLeaf * (place[j] - place[parent.index()])) : place[j];
    const bool is_pointless = !is_leaf && skeleton.size() > 1;  // all its children share its place
    if (!is_pointless) segments.push_back({JointId(j), place[j], tip});
  }
  return segments;
}

std::vector<JointId> nearest_bones(std::span<const Vec3> points, std::span<const BoneSegment> segments) {
  SF_EXPECT(!segments.empty());
  std::vector<JointId> nearest(points.size());
  parallel_chunks(points.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double least = segments[0].distance(points[v]);
      nearest[v] = segments[0].joint;
      for (const BoneSegment& segment : segments.subspan(1)) {
        const double distance = segment.distance(points[v]);
        if (distance >= least && !(distance == least && segment.joint < nearest[v])) continue;
        least = distance;
        nearest[v] = segment.joint;
      }
    }
  });
  return nearest;
}

}  // namespace skinforge
