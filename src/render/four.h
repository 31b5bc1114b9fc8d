#pragma once

#include <cstdint>
#include <cstring>

/// Four numbers in one register (vector types of GCC and Clang), for the two innermost loops of the renderer:
/// at -O2 the compiler leaves loops this short scalar, which cost a third of the drawing time.
namespace skinforge {

using FourFloats = float __attribute__((vector_size(16)));
using FourInts =
    std::int32_t __attribute__((vector_size(16)));  ///< as the result of a comparison: -1 = true, 0 = false

inline FourFloats load_four(const float* from) {
  FourFloats values;
  std::memcpy(&values, from, sizeof values);
  return values;
}
inline FourInts load_four(const std::int32_t* from) {
  FourInts values;
  std::memcpy(&values, from, sizeof values);
  return values;
}
inline void store_four(const FourFloats& values, float* to) {
  std::memcpy(to, &values, sizeof values);
}
inline void store_four(const FourInts& values, std::int32_t* to) {
  std::memcpy(to, &values, sizeof values);
}

}  // namespace skinforge
