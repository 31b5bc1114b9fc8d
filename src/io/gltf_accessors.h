#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/archive.h"
#include "io/gltf_json.h"

namespace skinforge {

/// The bytes of each buffer of a document.
struct GltfBuffers {
  std::vector<std::span<const std::byte>> spans;
  std::vector<Bytes> owned;  ///< what was decoded from data URIs; `spans` point into it
};

/// What an accessor declares, checked against its view.
struct GltfAccessor {
  std::string place;           ///< "/accessors/3"
  std::string type;            ///< SCALAR, VEC2, ... MAT4
  std::size_t components = 1;  ///< 1 to 16
  int component_type = 0;      ///< GL constant: 5120 (byte) to 5126 (float)
  bool normalized = false;
  std::size_t count = 0;
  const std::byte* data = nullptr;  ///< first element; null = all zero
  std::size_t stride = 0;           ///< bytes from one element to the next
  bool strided_view = false;        ///< the view declares byteStride
  struct Sparse {
    std::vector<std::uint32_t> indices;  ///< rising
    const std::byte* data = nullptr;     ///< tightly packed values
  };
  std::optional<Sparse> sparse;

  bool is_float() const { return component_type == 5126; }
};

/// Elements of an accessor as doubles, element after element. Floats are converted without change; normalised
/// integers are divided as glTF 2.0, section 3.6.2.2 says, others keep their value.
struct GltfValues {
  std::size_t count = 0;
  std::size_t components = 1;
  std::vector<double> numbers;

  const double* operator[](std::size_t element) const { return numbers.data() + element * components; }
};

/// All buffer views and accessors of a document. Construction checks every one of them, used or not:
/// references, types, strides, and that each element lies inside its view and each view inside its buffer.
/// The buffers must outlive it. Throws Error (BadInput) "/accessors/3/count: ...".
class GltfAccessors {
 public:
  GltfAccessors(const JsonPlace& root, const GltfBuffers& buffers);

  std::size_t size() const { return accessors_.size(); }
  const GltfAccessor& operator[](std::size_t i) const { return accessors_[i]; }
  /// The accessor that `reference` holds the index of; it must have one of `types` and one of the component
  /// types.
  const GltfAccessor& find(const JsonPlace& reference, std::initializer_list<std::string_view> types,
                           std::initializer_list<int> component_types) const;
  /// The bytes of a buffer view.
  std::span<const std::byte> view(std::size_t i) const { return views_[i].bytes; }
  std::size_t view_count() const { return views_.size(); }

  static GltfValues values(const GltfAccessor& accessor);
  /// Throws when an element of the accessor is NaN or infinite.
  static void check_finite(const GltfAccessor& accessor);

 private:
  struct View {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;  ///< 0 = tightly packed
  };
  void read_view(const JsonPlace& place, const GltfBuffers& buffers);
  GltfAccessor read_accessor(const JsonPlace& place) const;
  void read_data(const JsonPlace& place, GltfAccessor& accessor) const;
  GltfAccessor::Sparse read_sparse(const JsonPlace& place, const GltfAccessor& accessor) const;
  const std::byte* packed(const JsonPlace& place, std::size_t size) const;

  std::vector<View> views_;
  std::vector<GltfAccessor> accessors_;
};

namespace gltf {
inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                     kUnsignedInt = 5125, kFloat = 5126;
}  // namespace gltf

}  // namespace skinforge
