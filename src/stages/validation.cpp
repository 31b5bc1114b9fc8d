#include "stages/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skinforge {
namespace {

constexpr double kFloat =
    1e-6;  // positions are written as 32-bit floats: 24 bits of the diagonal, a few roundings

class Comparison {
 public:
  void expect(bool holds, std::string fault) {
    ++result_.checks;
    if (!holds) result_.faults.push_back(std::move(fault));
  }
  void expect_equal(std::size_t meant, std::size_t read, const char* what) {
    expect(meant == read, fmt::format("{} {} were written, {} are read back", meant, what, read));
  }
  Validation result_;
};

void compare_skeletons(Comparison& c, const Skeleton& meant, const Skeleton& read) {
  c.expect_equal(meant.size(), read.size(), "joints");
  for (const Joint& joint : meant.joints) {
    const auto found = read.find(joint.name);
    c.expect(found.has_value(), fmt::format("joint \"{}\" is not read back", joint.name));
    if (!found) continue;
    const JointId parent = read[*found].parent;
    const std::string wanted = joint.parent.is_valid() ? meant[joint.parent].name : "";
    c.expect((parent.is_valid() ? read[parent].name : "") == wanted,
             fmt::format("joint \"{}\" has another parent", joint.name));
  }
}

void compare_clips(Comparison& c, const Character& meant, const Character& read) {
  c.expect_equal(meant.clips.size(), read.clips.size(), "clips");
  for (const Clip& clip : meant.clips) {
    const auto found = std::find_if(read.clips.begin(), read.clips.end(),
                                    [&](const Clip& r) { return r.name == clip.name; });
    c.expect(found != read.clips.end(), fmt::format("clip \"{}\" is not read back", clip.name));
    if (found == read.clips.end()) continue;
    c.expect(
        std::abs(found->duration - clip.duration) <= kFloat * std::max(1.0, clip.duration),
        fmt::format("clip \"{}\" lasts {} s instead of {} s", clip.name, found->duration, clip.duration));
  }
}

std::vector<std::array<double, 3>> sorted_positions(const PolygonMesh& mesh) {
  std::vector<std::array<double, 3>> all;
  for (const Vec3& p : mesh.positions)
    all.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void compare_meshes(Comparison& c, const PolygonMesh& meant, const PolygonMesh& read) {
  const std::size_t halves = meant.split.size();  // quads that are written as two triangles
  c.expect_equal(meant.face_count() + halves, read.face_count(), "faces");
  const auto a = sorted_positions(meant), b = sorted_positions(read);
  c.expect_equal(a.size(), b.size(), "distinct positions");
  if (a.size() != b.size()) return;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < 3; ++k)
      c.result_.largest_offset = std::max(c.result_.largest_offset, std::abs(a[i][k] - b[i][k]));
  c.result_.largest_offset /= std::max(meant.diagonal(), 1e-300);
  c.expect(c.result_.largest_offset <= kFloat,
           fmt::format("a vertex is read back {:.3g} of the diagonal away", c.result_.largest_offset));
}

}  // namespace

Validation compare_with_written(const Character& meant, const Character& read) {
  Comparison c;
  compare_skeletons(c, meant.skeleton, read.skeleton);
  compare_clips(c, meant, read);
  compare_meshes(c, meant.mesh, read.mesh);
  c.expect_equal(meant.materials.size(), read.materials.size(), "materials");
  c.expect_equal(meant.images.size(), read.images.size(), "images");
  return c.result_;
}

}  // namespace skinforge
