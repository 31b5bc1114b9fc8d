#include <openvdb/io/Stream.h>

#include <cstring>
#include <sstream>

#include "base/expect.h"
#include "field/vdb/vdb_grid.h"
#include "field/vdb/vdb_module.h"

namespace skinforge {
namespace {

bool reaches_band(float low, float high, float background) {
  return low < background && high > -background;
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
  const auto grid = sparse_grid(field, 0, static_cast<float>(field.lattice.voxel), reaches_band);
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
