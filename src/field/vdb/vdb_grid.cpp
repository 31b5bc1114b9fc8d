#include "field/vdb/vdb_grid.h"

#include <algorithm>
#include <cmath>

#include "base/expect.h"

namespace skinforge {
namespace {

constexpr int kBlock = openvdb::FloatTree::LeafNodeType::DIM;

// Values of the lattice, continued beyond its faces.
class Values {
 public:
  Values(const DistanceField& field, float unit) : field_(field), unit_(unit) {}

  float at(const openvdb::Coord& c) const {
    const auto& size = field_.lattice.size;
    return unit_ * field_.values[field_.lattice.index(std::clamp(c.x(), 0, size[0] - 1),
                                                      std::clamp(c.y(), 0, size[1] - 1),
                                                      std::clamp(c.z(), 0, size[2] - 1))];
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
  float unit_;
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

}  // namespace

openvdb::FloatGrid::Ptr sparse_grid(const DistanceField& field, int padding, float unit,
                                    bool (*keep)(float low, float high, float background)) {
  openvdb::initialize();
  SF_EXPECT(field.values.size() == field.lattice.count());
  const float background = unit * largest_of(field);
  auto grid = openvdb::FloatGrid::create(background);
  if (field.values.empty()) return grid;
  const Values values(field, unit);
  const auto& size = field.lattice.size;
  const openvdb::CoordBBox inside(openvdb::Coord(-padding),
                                  openvdb::Coord(size[0], size[1], size[2]).offsetBy(padding - 1));
  const openvdb::Coord first = inside.min() & ~(kBlock - 1);
  for (int z = first.z(); z <= inside.max().z(); z += kBlock)
    for (int y = first.y(); y <= inside.max().y(); y += kBlock)
      for (int x = first.x(); x <= inside.max().x(); x += kBlock) {
        const openvdb::Coord corner(x, y, z);
        const auto block = openvdb::CoordBBox::createCube(corner, kBlock);
        auto around = block;
        around.expand(1);
        around.intersect(inside);
        const auto [low, high] = values.extremes(around);
        if (keep(low, high, background))
          fill_leaf(grid->tree(), values, block, inside, background);
        else if (high < 0)
          grid->tree().addTile(1, corner, -background, false);
      }
  return grid;
}

}  // namespace skinforge
