#pragma once

#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/archive.h"
#include "io/glb_json.h"

namespace skinforge {

/// The binary chunk of a GLB under construction, with the accessors and buffer views into it. All starts are
/// multiples of 4.
class GlbBuffer {
 public:
  enum class Use { Vertices, Indices, Animation, Other };

  /// Adds an accessor over tightly packed elements and returns its index; `T` is float, uint8, uint16 or
  /// uint32. Vertex attributes of 1- and 2-byte components must have 4 components (so that each element is
  /// aligned). Animation data share one view, and equal ones one accessor. `bounds` writes min and max.
  template <class T>
  std::size_t add(Use use, const char* type, std::span<const T> numbers, bool bounds = false) {
    Bytes bytes(numbers.size_bytes());
    if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return add_accessor(use, type, component_type(T{}), std::move(bytes), bounds);
  }
  /// Adds bytes without accessor (images) and returns the index of their view.
  std::size_t add_view(std::span<const std::byte> bytes) { return append(Use::Other, bytes); }

  /// Writes the members "accessors", "bufferViews" and "buffers".
  void write(JsonText& json) const;
  const Bytes& bytes() const { return bytes_; }
  /// Puts the animation data behind the rest. Call once, when everything has been added.
  void close();

 private:
  struct Accessor {
    std::size_t view = 0;
    std::size_t offset = 0;
    std::string type;
    int component_type = 0;
    std::size_t count = 0;
    std::vector<double> min, max;
    bool is_animation = false;
  };
  struct View {
    std::size_t offset = 0;
    std::size_t length = 0;
    Use use = Use::Other;
  };

  static int component_type(std::uint8_t) { return 5121; }
  static int component_type(std::uint16_t) { return 5123; }
  static int component_type(std::uint32_t) { return 5125; }
  static int component_type(float) { return 5126; }

  std::size_t add_accessor(Use use, const char* type, int component_type, Bytes bytes, bool bounds);
  std::size_t append(Use use, std::span<const std::byte> bytes);
  static void find_bounds(Accessor& accessor, const Bytes& bytes);

  Bytes bytes_;
  Bytes animation_;  ///< gathered apart, so that it becomes one view
  std::vector<Accessor> accessors_;
  std::vector<View> views_;
  std::map<std::pair<std::string, Bytes>, std::size_t> animation_accessors_;  ///< by type and data
};

}  // namespace skinforge
