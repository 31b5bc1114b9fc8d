#pragma once

#include <string>
#include <vector>

#include "model/character.h"

namespace skinforge {

/// What reading the output back showed.
struct Validation {
  std::size_t checks = 0;           ///< comparisons made
  std::vector<std::string> faults;  ///< one sentence each; empty when the file is sound
  double largest_offset = 0;        ///< of a bind-pose vertex, in units of the diagonal

  template <class Archive>
  friend void fields(Archive& a, Validation& v) {
    a(v.checks, v.faults, v.largest_offset);
  }
};

/// Compares a character with the one that was read back from its file: joints by name and parent, bind pose,
/// clips by name, duration and tracks, faces, materials, images, positions (as sets: the reader may order
/// vertices differently).
Validation compare_with_written(const Character& meant, const Character& read);

}  // namespace skinforge
