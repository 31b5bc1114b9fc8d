#include "io/glb_buffer.h"

#include <algorithm>

namespace skinforge {
namespace {

constexpr std::size_t kArrayBuffer = 34962, kElementArrayBuffer = 34963;  // GL targets

std::size_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "MAT4") return 16;
  return static_cast<std::size_t>(type.back() - '0');
}

std::size_t component_size(int component_type) {
  return component_type == 5121 ? 1 : component_type == 5123 ? 2 : 4;
}

void pad(Bytes& bytes) {
  bytes.resize((bytes.size() + 3) / 4 * 4);
}

}  // namespace

std::size_t GlbBuffer::append(Use use, std::span<const std::byte> bytes) {
  pad(bytes_);
  views_.push_back({bytes_.size(), bytes.size(), use});
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return views_.size() - 1;
}

std::size_t GlbBuffer::add_accessor(Use use, const char* type, int component_type, Bytes bytes, bool bounds) {
  Accessor accessor;
  accessor.type = type;
  accessor.component_type = component_type;
  accessor.count = bytes.size() / (component_count(accessor.type) * component_size(component_type));
  accessor.is_animation = use == Use::Animation;
  if (bounds) find_bounds(accessor, bytes);
  if (accessor.is_animation) {
    const std::string kind = accessor.type + (bounds ? " bounded" : "");
    const auto [known, is_new] = animation_accessors_.try_emplace({kind, bytes}, accessors_.size());
    if (!is_new) return known->second;
    accessor.offset = animation_.size();  // keys are floats: always aligned
    animation_.insert(animation_.end(), bytes.begin(), bytes.end());
  } else {
    accessor.view = append(use, bytes);
  }
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

void GlbBuffer::find_bounds(Accessor& accessor, const Bytes& bytes) {
  const std::size_t components = component_count(accessor.type);
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  for (std::size_t c = 0; c < components && !numbers.empty(); ++c) {
    float low = numbers[c], high = numbers[c];
    for (std::size_t i = c; i < numbers.size(); i += components) {
      low = std::min(low, numbers[i]);
      high = std::max(high, numbers[i]);
    }
    accessor.min.push_back(low);
    accessor.max.push_back(high);
  }
}

void GlbBuffer::close() {
  if (!animation_.empty()) {
    const std::size_t view = append(Use::Animation, animation_);
    for (Accessor& accessor : accessors_)
      if (accessor.is_animation) accessor.view = view;
  }
  pad(bytes_);
}

void GlbBuffer::write(JsonText& json) const {
  if (bytes_.empty()) return;
  if (!accessors_.empty()) json.key("accessors");
  if (!accessors_.empty()) json.begin_array();
  for (const Accessor& accessor : accessors_) {
    json.begin_object();
    json.member("bufferView", accessor.view);
    if (accessor.offset > 0) json.member("byteOffset", accessor.offset);
    json.member("componentType", static_cast<std::size_t>(accessor.component_type));
    json.member("count", accessor.count);
    json.member("type", accessor.type);
    if (!accessor.min.empty()) json.member("min", accessor.min);
    if (!accessor.max.empty()) json.member("max", accessor.max);
    json.end_object();
  }
  if (!accessors_.empty()) json.end_array();
  json.key("bufferViews");
  json.begin_array();
  for (const View& view : views_) {
    json.begin_object();
    json.member("buffer", std::size_t{0});
    if (view.offset > 0) json.member("byteOffset", view.offset);
    json.member("byteLength", view.length);
    if (view.use == Use::Vertices) json.member("target", kArrayBuffer);
    if (view.use == Use::Indices) json.member("target", kElementArrayBuffer);
    json.end_object();
  }
  json.end_array();
  json.key("buffers");
  json.begin_array();
  json.begin_object();
  json.member("byteLength", bytes_.size());
  json.end_object();
  json.end_array();
}

}  // namespace skinforge
