#include "io/gltf_accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/limits.h"

namespace skinforge {
namespace {

constexpr std::size_t kMinStride = 4, kMaxStride = 252;  // glTF 2.0, bufferView schema

std::size_t component_size(int type) {
  switch (type) {
    case gltf::kByte:
    case gltf::kUnsignedByte:
      return 1;
    case gltf::kShort:
    case gltf::kUnsignedShort:
      return 2;
    case gltf::kUnsignedInt:
    case gltf::kFloat:
      return 4;
    default:
      return 0;
  }
}

std::size_t component_count(std::string_view type) {
  constexpr std::pair<std::string_view, std::size_t> kTypes[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, count] : kTypes)
    if (name == type) return count;
  return 0;
}

template <class T>
double component(const std::byte* data, bool normalized) {
  T value;
  std::memcpy(&value, data, sizeof value);
  if constexpr (std::is_integral_v<T>)
    if (normalized) return std::max(static_cast<double>(value) / std::numeric_limits<T>::max(), -1.0);
  return static_cast<double>(value);
}

double component(const std::byte* data, int type, bool normalized) {
  switch (type) {
    case gltf::kByte:
      return component<std::int8_t>(data, normalized);
    case gltf::kUnsignedByte:
      return component<std::uint8_t>(data, normalized);
    case gltf::kShort:
      return component<std::int16_t>(data, normalized);
    case gltf::kUnsignedShort:
      return component<std::uint16_t>(data, normalized);
    case gltf::kUnsignedInt:
      return component<std::uint32_t>(data, normalized);
    default:
      return component<float>(data, normalized);
  }
}

/// Offset of component `c` inside an element: columns of 1- and 2-byte matrices start at multiples of 4
/// bytes.
std::size_t component_offset(const GltfAccessor& a, std::size_t c) {
  const std::size_t size = component_size(a.component_type);
  if (!a.type.starts_with("MAT")) return c * size;
  const std::size_t rows = static_cast<std::size_t>(a.type.back() - '0');
  const std::size_t column_stride = (rows * size + 3) / 4 * 4;
  return c / rows * column_stride + c % rows * size;
}

std::size_t element_size(const GltfAccessor& a) {
  return component_offset(a, a.components - 1) + component_size(a.component_type);
}

/// Reads elements of one accessor.
class ElementReader {
 public:
  explicit ElementReader(const GltfAccessor& accessor) : accessor_(accessor) {
    for (std::size_t c = 0; c < accessor.components; ++c) offsets_[c] = component_offset(accessor, c);
  }

  void read(const std::byte* element, double* out) const {
    for (std::size_t c = 0; c < accessor_.components; ++c)
      out[c] = component(element + offsets_[c], accessor_.component_type, accessor_.normalized);
  }

 private:
  const GltfAccessor& accessor_;
  std::array<std::size_t, 16> offsets_{};  // MAT4 has the most components
};

}  // namespace

GltfAccessors::GltfAccessors(const JsonPlace& root, const GltfBuffers& buffers) {
  for (const JsonPlace& place : root.objects("bufferViews")) read_view(place, buffers);
  for (const JsonPlace& place : root.objects("accessors")) accessors_.push_back(read_accessor(place));
}

void GltfAccessors::read_view(const JsonPlace& place, const GltfBuffers& buffers) {
  const auto buffer = buffers.spans[place.get("buffer").index(buffers.spans.size(), "buffer")];
  const std::size_t offset = place.count_or("byteOffset", 0);
  const std::size_t length = place.get("byteLength").count();
  // Both are at most 2^53, so the sum cannot overflow.
  if (offset + length > buffer.size())
    place.get("byteLength")
        .fail(fmt::format("the view ends at byte {}, its buffer has {}", offset + length, buffer.size()));
  const std::size_t stride = place.count_or("byteStride", 0);
  if (place.has("byteStride") && (stride < kMinStride || stride > kMaxStride || stride % 4 != 0))
    place.get("byteStride")
        .fail(fmt::format("{} is not a multiple of 4 from {} to {}", stride, kMinStride, kMaxStride));
  views_.push_back({buffer.subspan(offset, length), stride});
}

GltfAccessor GltfAccessors::read_accessor(const JsonPlace& place) const {
  GltfAccessor accessor;
  accessor.place = place.place();
  accessor.type = place.get("type").text();
  accessor.components = component_count(accessor.type);
  if (accessor.components == 0)
    place.get("type").fail("is none of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4");
  accessor.component_type = static_cast<int>(place.get("componentType").index(1 << 16, "component type"));
  if (component_size(accessor.component_type) == 0)
    place.get("componentType")
        .fail(fmt::format("{} is none of 5120, 5121, 5122, 5123, 5125, 5126", accessor.component_type));
  accessor.normalized = place.flag_or("normalized", false);
  accessor.count = place.get("count").count();
  if (accessor.count == 0) place.get("count").fail("is 0");
  read_data(place, accessor);
  if (const auto sparse = place.find("sparse")) accessor.sparse = read_sparse(*sparse, accessor);
  return accessor;
}

void GltfAccessors::read_data(const JsonPlace& place, GltfAccessor& accessor) const {
  const std::size_t size = element_size(accessor);
  const auto reference = place.find("bufferView");
  if (!reference) {
    if (accessor.count > limits().vertices)  // what has data is bounded by it
      place.get("count").fail(
          fmt::format("{} elements without data, {}", accessor.count, limit_hint("vertices")));
    return;
  }
  const View& view = views_[reference->index(views_.size(), "buffer view")];
  accessor.strided_view = view.stride > 0;
  accessor.stride = view.stride > 0 ? view.stride : size;
  if (accessor.stride < size)
    place.fail(fmt::format("elements of {} bytes in a view with a stride of {}", size, accessor.stride));
  const std::size_t offset = place.count_or("byteOffset", 0);
  // count, offset < 2^53 and stride <= 252: no overflow below 2^62.
  const std::size_t end = offset + accessor.stride * (accessor.count - 1) + size;
  if (end > view.bytes.size())
    place.get("count").fail(
        fmt::format("{} elements end at byte {}, the view has {}", accessor.count, end, view.bytes.size()));
  accessor.data = view.bytes.data() + offset;
}

/// Start of `size` tightly packed bytes in the view that a part of a sparse accessor names.
const std::byte* GltfAccessors::packed(const JsonPlace& place, std::size_t size) const {
  const View& view = views_[place.get("bufferView").index(views_.size(), "buffer view")];
  if (view.stride > 0) place.fail("sparse data in a view with a stride");
  const std::size_t offset = place.count_or("byteOffset", 0);
  if (offset + size > view.bytes.size())
    place.fail(fmt::format("{} bytes from byte {} on, the view has {}", size, offset, view.bytes.size()));
  return view.bytes.data() + offset;
}

GltfAccessor::Sparse GltfAccessors::read_sparse(const JsonPlace& place, const GltfAccessor& accessor) const {
  const std::size_t count = place.get("count").count();
  if (count == 0 || count > accessor.count)
    place.get("count").fail(fmt::format("{} of {} elements", count, accessor.count));
  const JsonPlace where = place.get("indices");
  const int type = static_cast<int>(where.get("componentType").index(1 << 16, "component type"));
  if (type != gltf::kUnsignedByte && type != gltf::kUnsignedShort && type != gltf::kUnsignedInt)
    where.get("componentType").fail("is none of 5121, 5123, 5125");
  const std::size_t size = component_size(type);
  const std::byte* index = packed(where, count * size);
  GltfAccessor::Sparse sparse;
  for (std::size_t i = 0; i < count; ++i, index += size) {
    const auto element = static_cast<std::uint32_t>(component(index, type, false));
    if (element >= accessor.count) where.fail(fmt::format("element {} of {}", element, accessor.count));
    if (i > 0 && element <= sparse.indices.back())
      where.fail(fmt::format("the indices do not rise at {}", i));
    sparse.indices.push_back(element);
  }
  sparse.data = packed(place.get("values"), count * element_size(accessor));
  return sparse;
}

const GltfAccessor& GltfAccessors::find(const JsonPlace& reference,
                                        std::initializer_list<std::string_view> types,
                                        std::initializer_list<int> component_types) const {
  const GltfAccessor& accessor = accessors_[reference.index(accessors_.size(), "accessor")];
  if (std::find(types.begin(), types.end(), accessor.type) == types.end())
    reference.fail(fmt::format("accessor of type {}, wanted {}", accessor.type, fmt::join(types, " or ")));
  if (std::find(component_types.begin(), component_types.end(), accessor.component_type) ==
      component_types.end())
    reference.fail(fmt::format("accessor of component type {}, wanted {}", accessor.component_type,
                               fmt::join(component_types, " or ")));
  return accessor;
}

GltfValues GltfAccessors::values(const GltfAccessor& accessor) {
  GltfValues values{accessor.count, accessor.components, {}};
  values.numbers.resize(accessor.count * accessor.components);
  double* out = values.numbers.data();
  const ElementReader reader(accessor);
  if (accessor.data != nullptr)
    for (std::size_t i = 0; i < accessor.count; ++i)
      reader.read(accessor.data + i * accessor.stride, out + i * accessor.components);
  if (accessor.sparse)
    for (std::size_t i = 0; i < accessor.sparse->indices.size(); ++i)
      reader.read(accessor.sparse->data + i * element_size(accessor),
                  out + accessor.sparse->indices[i] * accessor.components);
  return values;
}

void GltfAccessors::check_finite(const GltfAccessor& accessor) {
  if (!accessor.is_float()) return;
  const GltfValues all = values(accessor);
  for (std::size_t i = 0; i < all.numbers.size(); ++i)
    if (!std::isfinite(all.numbers[i]))
      throw Error(ExitCode::BadInput,
                  fmt::format("{}: element {} is not finite", accessor.place, i / accessor.components));
}

}  // namespace skinforge
