#pragma once

#include <span>
#include <string>

#include "io/import.h"

namespace skinforge::fuzz {

inline InputFile file_of(const std::string& path, std::span<const std::byte> bytes) {
  return {path, Bytes(bytes.begin(), bytes.end()), {}};
}

inline std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace skinforge::fuzz
