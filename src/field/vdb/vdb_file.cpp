#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "base/expect.h"
#include "field/vdb/vdb_module.h"

namespace skinforge {
namespace {

constexpr int kBlock = openvdb::FloatTree::LeafNodeType::DIM;

// Values of the lattice, in metres.
class Values {
 public:
  explicit Values(const DistanceField& field)
      : field_(field), voxel_(static_cast<float>(field.lattice.voxel)) {}

  float at(const openvdb::Coord& c) const {
    return voxel_ * field_.values[field_.lattice.index(c.x(), c.y(), c.z())];
  }

  std::pair<float, float> extremes(const openvdb::CoordBBox& box) const {
    float low = at(box.min()), high = low;
    for (auto c = box.begin(); c; ++c) {
      const float value = at(*c);
      low = std::min(low, value);
      high = std::max(high, value);
    }
    return {low, high};
  }

 private:
  const DistanceField& field_;
  float voxel_;
};

float largest_of(const DistanceField& field) {
  float largest = 1;
  for (const float value : field.values) largest = std::max(largest, std::abs(value));
  return largest;
}

void fill_leaf(openvdb::FloatTree& tree, const Values& values, const openvdb::CoordBBox& block,
               const openvdb::CoordBBox& inside, float background) {
  auto* leaf = tree.touchLeaf(block.min());
  for (auto c = block.begin(); c; ++c) {
    if (!inside.isInside(*c)) continue;
    const float value = values.at(*c);
    if (std::abs(value) < background)
      leaf->setValueOn(*c, value);
    else
      leaf->setValueOff(*c, std::copysign(background, value));
  }
}

// Blocks of 8 x 8 x 8 points that reach into the band, themselves or by neighbouring points, are stored, and
// active where |value| < background, the largest value, at least one voxel; the others become inactive tiles
// of plus or minus the background.
openvdb::FloatGrid::Ptr sparse_grid(const DistanceField& field) {
  openvdb::initialize();
  SF_EXPECT(field.values.size() == field.lattice.count());
  const float background = static_cast<float>(field.lattice.voxel) * largest_of(field);
  auto grid = openvdb::FloatGrid::create(background);
  if (field.values.empty()) return grid;
  const Values values(field);
  const auto& size = field.lattice.size;
  const openvdb::CoordBBox inside(openvdb::Coord(0), openvdb::Coord(size[0], size[1], size[2]).offsetBy(-1));
  for (int z = 0; z < size[2]; z += kBlock)
    for (int y = 0; y < size[1]; y += kBlock)
      for (int x = 0; x < size[0]; x += kBlock) {
        const openvdb::Coord corner(x, y, z);
        const auto block = openvdb::CoordBBox::createCube(corner, kBlock);
        auto around = block;
        around.expand(1);
        around.intersect(inside);
        const auto [low, high] = values.extremes(around);
        if (low < background && high > -background)
          fill_leaf(grid->tree(), values, block, inside, background);
        else if (high < 0)
          grid->tree().addTile(1, corner, -background, false);
      }
  return grid;
}

// OpenVDB writes a random identifier behind the magic number (8 bytes), three version numbers (4 each) and
// one flag. Readers only compare it between files, so every file of ours carries the nil one.
void blank_identifier(std::string& file) {
  constexpr std::size_t kBegin = 8 + 3 * 4 + 1;
  constexpr std::string_view kNil = "00000000-0000-0000-0000-000000000000";
  SF_EXPECT(file.size() > kBegin + kNil.size());
  for (std::size_t i = 0; i < kNil.size(); ++i) SF_EXPECT((file[kBegin + i] == '-') == (kNil[i] == '-'));
  file.replace(kBegin, kNil.size(), kNil);
}

}  // namespace

Bytes vdb::to_vdb(const DistanceField& field) {
  const auto grid = sparse_grid(field);
  grid->setName("distance");
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  const auto transform = openvdb::math::Transform::createLinearTransform(field.lattice.voxel);
  const Vec3& o = field.lattice.origin;
  transform->postTranslate(openvdb::Vec3d(o.x(), o.y(), o.z()));
  grid->setTransform(transform);

  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream stream(out);
  stream.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
  stream.write(openvdb::GridCPtrVec{grid});
  std::string file = out.str();
  blank_identifier(file);
  Bytes bytes(file.size());
  std::memcpy(bytes.data(), file.data(), file.size());
  return bytes;
}

}  // namespace skinforge
