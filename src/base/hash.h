#pragma once

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/archive.h"

namespace skinforge {

/// SHA-256 digest; printed as 64 lower-case hex digits.
struct Digest {
  std::array<std::uint8_t, 32> bytes{};

  std::string hex() const;
  auto operator<=>(const Digest&) const = default;

  template <class Archive>
  friend void fields(Archive& a, Digest& d) {
    a(d.bytes);
  }
};

/// The digest that `hex` spells; none when it is not 64 hex digits.
std::optional<Digest> digest_from_hex(std::string_view hex);

/// Digest of the bytes as they are.
Digest sha256(std::span<const std::byte> bytes);

/// A field as it went into a Hasher, for people to read.
struct HashedField {
  std::string name;
  std::string value;  ///< a text, list of texts or number as it is; anything else as "sha256:" and 12 digits
                      ///< of its digest
  auto operator<=>(const HashedField&) const = default;
};

/// Digest of a list of named fields: each name and value is length-prefixed, so no two lists collide by
/// concatenation.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  void add(std::string_view name, std::span<const std::byte> value);
  void add(std::string_view name, std::string_view value);
  void add(std::string_view name, const char* value) { add(name, std::string_view(value)); }
  void add(std::string_view name, const Digest& value);
  /// Any archivable value: numbers by their bits, structs by their fields.
  template <class T>
  void add_value(std::string_view name, const T& value) {
    const Bytes bytes = to_bytes(value);
    if constexpr (std::is_arithmetic_v<T>)
      add_bytes(name, bytes, fmt::format("{}", value));
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
      add_bytes(name, bytes, list_text(value));
    else
      add(name, std::span<const std::byte>(bytes));
  }
  /// Notes each further field in `log` too, without effect on the digest. `log` must outlive the hasher.
  void log_to(std::vector<HashedField>& log);
  /// Ends the list. The hasher must not be used after.
  Digest finish();

 private:
  static std::string list_text(std::span<const std::string> words);
  void add_bytes(std::string_view name, std::span<const std::byte> value, std::string readable);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace skinforge
