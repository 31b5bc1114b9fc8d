#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

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
    add(name, std::span<const std::byte>(bytes));
  }
  /// Ends the list. The hasher must not be used after.
  Digest finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace skinforge
