#pragma once

#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/id.h"
#include "base/math.h"

/// Binary form of plain data for the cache: little endian, length-prefixed, no versions (the cache key has
/// them). A struct opts in with one friend, used for writing and reading alike:
///   template <class Archive> friend void fields(Archive& a, Joint& j) { a(j.name, j.parent); }
namespace skinforge {

using Bytes = std::vector<std::byte>;

namespace archive_detail {
template <class T>
inline constexpr bool is_flat = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <class Tag>
inline constexpr bool is_flat<Id<Tag>> = true;
template <class T, std::size_t N>
inline constexpr bool is_flat<std::array<T, N>> = is_flat<T>;
template <int R>
inline constexpr bool is_flat<Eigen::Matrix<double, R, 1>> = R > 0;  // coefficients only, no padding
template <>
inline constexpr bool is_flat<std::byte> = true;
template <class T>
struct EigenSize : std::integral_constant<int, 0> {};
template <int R>
struct EigenSize<Eigen::Matrix<double, R, 1>> : std::integral_constant<int, R> {};
template <>
struct EigenSize<Mat3> : std::integral_constant<int, 9> {};
template <>
struct EigenSize<Quat> : std::integral_constant<int, 4> {};
template <>
struct EigenSize<Affine3> : std::integral_constant<int, 12> {};

template <class T>
double* coefficients(T& value) {
  if constexpr (std::is_same_v<T, Quat>)
    return value.coeffs().data();
  else if constexpr (std::is_same_v<T, Affine3>)
    return value.matrix().data();
  else
    return value.data();
}
}  // namespace archive_detail

class ArchiveWriter {
 public:
  static constexpr bool kReading = false;

  template <class... Ts>
  void operator()(const Ts&... values) {
    (write(values), ...);
  }
  Bytes take() { return std::move(bytes_); }

 private:
  void raw(const void* data, std::size_t size) {
    const auto* begin = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  void count(std::size_t n) {
    const auto wide = static_cast<std::uint64_t>(n);
    raw(&wide, sizeof wide);
  }
  template <class T>
  void write(const T& value) {
    using archive_detail::EigenSize;
    if constexpr (std::is_same_v<T, bool>) {
      const std::uint8_t byte = value ? 1 : 0;
      raw(&byte, 1);
    } else if constexpr (archive_detail::is_flat<T>) {
      raw(&value, sizeof value);
    } else if constexpr (EigenSize<T>::value > 0) {
      raw(archive_detail::coefficients(const_cast<T&>(value)), EigenSize<T>::value * sizeof(double));
    } else {
      fields(*this, const_cast<T&>(value));  // `fields` serves both directions; a writer leaves it unchanged
    }
  }
  void write(const std::string& text) {
    count(text.size());
    raw(text.data(), text.size());
  }
  template <class T>
  void write(const std::vector<T>& items) {
    count(items.size());
    if constexpr (archive_detail::is_flat<T>) {
      raw(items.data(), items.size() * sizeof(T));
    } else {
      for (const T& item : items) write(item);
    }
  }
  void write(const std::vector<bool>& items) {
    count(items.size());
    for (const bool item : items) write(item);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& items) {
    for (const T& item : items) write(item);
  }
  template <class T>
  void write(const std::optional<T>& item) {
    write(item.has_value());
    if (item) write(*item);
  }
  template <class K, class V>
  void write(const std::map<K, V>& items) {
    count(items.size());
    for (const auto& [key, value] : items) {
      write(key);
      write(value);
    }
  }
  template <class A, class B>
  void write(const std::pair<A, B>& item) {
    write(item.first);
    write(item.second);
  }

  Bytes bytes_;
};

/// Reads what `ArchiveWriter` wrote. Bytes that end early or claim more than they hold throw `Error`
/// (Internal): the cache verifies digests first, so this means a codec changed without its stage's version.
class ArchiveReader {
 public:
  static constexpr bool kReading = true;

  explicit ArchiveReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class... Ts>
  void operator()(Ts&... values) {
    (read(values), ...);
  }
  bool at_end() const { return rest_.empty(); }

 private:
  void raw(void* data, std::size_t size) {
    if (size > rest_.size()) throw Error(ExitCode::Internal, "archive ends early");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
  }
  std::size_t count() {
    std::uint64_t wide = 0;
    raw(&wide, sizeof wide);
    if (wide > rest_.size()) throw Error(ExitCode::Internal, "archive claims more items than it has bytes");
    return static_cast<std::size_t>(wide);
  }
  template <class T>
  void read(T& value) {
    using archive_detail::EigenSize;
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      raw(&byte, 1);
      value = byte != 0;
    } else if constexpr (archive_detail::is_flat<T>) {
      raw(&value, sizeof value);
    } else if constexpr (EigenSize<T>::value > 0) {
      raw(archive_detail::coefficients(value), EigenSize<T>::value * sizeof(double));
    } else {
      fields(*this, value);
    }
  }
  void read(std::string& text) {
    text.resize(count());
    raw(text.data(), text.size());
  }
  template <class T>
  void read(std::vector<T>& items) {
    items.resize(count());
    if constexpr (archive_detail::is_flat<T>) {
      raw(items.data(), items.size() * sizeof(T));
    } else {
      for (T& item : items) read(item);
    }
  }
  void read(std::vector<bool>& items) {
    items.resize(count());
    for (std::size_t i = 0; i < items.size(); ++i) {
      bool item = false;
      read(item);
      items[i] = item;
    }
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& items) {
    for (T& item : items) read(item);
  }
  template <class T>
  void read(std::optional<T>& item) {
    bool present = false;
    read(present);
    item.reset();
    if (present) read(item.emplace());
  }
  template <class K, class V>
  void read(std::map<K, V>& items) {
    items.clear();
    const std::size_t n = count();
    for (std::size_t i = 0; i < n; ++i) {
      K key{};
      read(key);
      read(items[key]);
    }
  }
  template <class A, class B>
  void read(std::pair<A, B>& item) {
    read(item.first);
    read(item.second);
  }

  std::span<const std::byte> rest_;
};

template <class T>
Bytes to_bytes(const T& value) {
  ArchiveWriter writer;
  writer(value);
  return writer.take();
}

template <class T>
T from_bytes(std::span<const std::byte> bytes) {
  ArchiveReader reader(bytes);
  T value{};
  reader(value);
  if (!reader.at_end()) throw Error(ExitCode::Internal, "archive has bytes left over");
  return value;
}

}  // namespace skinforge
