#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace skinforge {

/// What an input may ask for at most. A limit never changes a result, it only refuses one; so none is part of
/// a key. Beyond each of them the error gives the number and the option that raises it (`limit_hint`). Depths
/// of JSON, recipes and includes are not among them: those bound recursion.
struct Limits {
  std::uint64_t file = std::uint64_t{512} << 20;   ///< bytes of one input file
  std::uint64_t nodes = 65'536;                    ///< of a scene
  std::uint64_t depth = 1'024;                     ///< levels of the node tree
  std::uint64_t joints = 4'096;                    ///< of a skin
  std::uint64_t vertices = 10'000'000;             ///< of a file, morph targets counted
  std::uint64_t keys = 200'000'000;                ///< numbers in the keys of a file, 1.6 GB
  std::uint64_t clip = 24 * 3600;                  ///< seconds of a clip
  std::uint64_t frames = 1'000'000;                ///< of all clips of an input, resampled
  std::uint64_t image_side = 16'384;               ///< pixels
  std::uint64_t pixels = std::uint64_t{1} << 28;   ///< of an image
  std::uint64_t inflate = std::uint64_t{1} << 30;  ///< bytes that one packed block may unpack to
  std::uint64_t memory = std::uint64_t{2}
                         << 30;  ///< bytes of one lattice, of an input's frames, of one decoded image
  std::uint64_t import_memory = std::uint64_t{2} << 30;   ///< bytes of address space of the import child
  std::uint64_t import_stack = std::uint64_t{512} << 20;  ///< bytes
  std::uint64_t import_seconds = 10;                      ///< processor time of the import child
  std::uint64_t import_wait = 120;                        ///< seconds that the child may take at all

  template <class Archive>
  friend void fields(Archive& a, Limits& l) {
    a(l.file, l.nodes, l.depth, l.joints, l.vertices, l.keys, l.clip, l.frames, l.image_side, l.pixels,
      l.inflate, l.memory, l.import_memory, l.import_stack, l.import_seconds, l.import_wait);
  }
};

/// The limits of this process.
const Limits& limits();
/// Not while imports or stages run.
void set_limits(const Limits& limits);

/// Changes one limit by a text "vertices=20M": the name with `-` for `_`, a whole number, and K, M or G
/// (1024-fold for bytes, 1000-fold for counts). Throws Error (Usage) with the nearest name or what is wrong
/// with the number.
void set_limit(Limits& limits, const std::string& text);

/// "the limit is 10000000; --limit vertices=N raises it", for messages.
std::string limit_hint(std::string_view name);

/// Names, defaults and meanings, one a line, for the help.
std::string limit_table();

}  // namespace skinforge
