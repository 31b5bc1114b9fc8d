#pragma once

#include <cstddef>
#include <cstring>

// Compiles a function for several instruction sets; the widest that the processor has is taken when the
// program starts. The bits do not depend on it: each lane does the same operations in the same order, and
// multiplications and additions are never fused (-ffp-contract=off).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define SKINFORGE_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SKINFORGE_VECTOR_CLONES
#endif

namespace skinforge {

/// Sixteen floats that are worked on together (a vector extension of GCC and Clang, which splits them where
/// registers are shorter).
struct Lanes {
  static constexpr std::size_t kCount = 16;
  using Vector [[gnu::vector_size(kCount * sizeof(float))]] = float;
  using Bits [[gnu::vector_size(kCount * sizeof(int))]] = int;
  Vector v;

  [[gnu::always_inline]] static Lanes load(const float* from) {
    Lanes lanes;
    std::memcpy(&lanes.v, from, sizeof(lanes.v));
    return lanes;
  }
  [[gnu::always_inline]] static Lanes all(float value) { return {Vector{} + value}; }
  [[gnu::always_inline]] void store(float* to) const { std::memcpy(to, &v, sizeof(v)); }

  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) { return {a.v + b.v}; }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, float b) { return {a.v * b}; }
  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, float b) { return {a.v + b}; }
  [[gnu::always_inline]] friend Lanes min(const Lanes& a, const Lanes& b) { return {b.v < a.v ? b.v : a.v}; }
  [[gnu::always_inline]] friend Lanes max(const Lanes& a, const Lanes& b) { return {a.v < b.v ? b.v : a.v}; }
  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) {
    return {reinterpret_cast<Vector>(reinterpret_cast<Bits>(a.v) & 0x7fffffff)};
  }
};

}  // namespace skinforge
