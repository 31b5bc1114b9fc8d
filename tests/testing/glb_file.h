#pragma once

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "io/import.h"

namespace skinforge::testing {

inline Bytes bytes_of(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

/// Little-endian bytes of numbers, one after another.
template <class T>
void append_numbers(Bytes& bytes, const std::vector<T>& numbers) {
  const auto view = std::as_bytes(std::span(numbers));
  bytes.insert(bytes.end(), view.begin(), view.end());
}

/// A GLB file of JSON text and binary data, both padded to 4 bytes.
inline Bytes glb_bytes(std::string json, Bytes binary = {}) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4);
  Bytes file = bytes_of("glTF");
  const auto word = [&](std::size_t value) {
    append_numbers<std::uint32_t>(file, {static_cast<std::uint32_t>(value)});
  };
  word(2);
  word(12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size()));
  word(json.size());
  word(0x4E4F534A);
  for (const std::byte b : bytes_of(json)) file.push_back(b);
  if (binary.empty()) return file;
  word(binary.size());
  word(0x004E4942);
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

/// What `read_gltf` takes: one file in memory.
inline std::vector<InputFile> as_input(const std::string& path, Bytes bytes) {
  return {{path, std::move(bytes), {}}};
}

}  // namespace skinforge::testing
