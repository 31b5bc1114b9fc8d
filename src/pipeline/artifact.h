#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <typeindex>

#include "base/archive.h"
#include "base/hash.h"

namespace skinforge {

/// One result of a stage, or a source, known by its digest. Its bytes are loaded when somebody asks, its
/// value is decoded once and shared by everyone who reads it. Safe to use from several threads.
///
/// `Bytes` are stored raw; any other type by `to_bytes`. One artifact is read as one type only.
class Artifact {
 public:
  /// Gives the bytes of the digest, or none when they are missing or damaged.
  using Loader = std::function<std::optional<Bytes>()>;

  /// An artifact whose bytes are elsewhere.
  Artifact(Digest digest, std::uint64_t size, Loader loader);

  /// An artifact made just now; keeps value and bytes.
  template <class T>
  static std::shared_ptr<Artifact> of(T value);

  const Digest& digest() const { return digest_; }
  std::uint64_t size() const { return size_; }

  /// The decoded value, alive as long as the artifact. Throws Error (Internal) when the bytes cannot be
  /// loaded any more or do not decode as `T`, and when it was read as another type before.
  template <class T>
  const T& get() const;

  /// The bytes as stored: those held, else loaded anew, else encoded from the value. None when the value is
  /// not held either.
  std::shared_ptr<const Bytes> bytes() const;

  /// Loads the bytes unless they, or the value, are held. False when the loader has none.
  bool try_load() const;

  /// From now on the bytes can be had from `loader`, so memory need not hold them beside a decoded value.
  void stored(Loader loader);

  /// Puts back bytes that were lost; they must have this artifact's digest.
  void restore(Bytes bytes);

 private:
  template <class T>
  const T& hold(std::shared_ptr<const T> value) const;
  std::shared_ptr<const Bytes> load() const;
  void expect_type(std::type_index type) const;

  Digest digest_;
  std::uint64_t size_ = 0;
  mutable std::mutex mutex_;
  Loader loader_;
  mutable std::shared_ptr<const Bytes> bytes_;
  mutable std::shared_ptr<const void> value_;
  mutable std::optional<std::type_index> type_;
  mutable Bytes (*encode_)(const void* value) = nullptr;
};

template <class T>
std::shared_ptr<Artifact> Artifact::of(T value) {
  const auto held = std::make_shared<const T>(std::move(value));
  std::shared_ptr<const Bytes> bytes;
  if constexpr (std::is_same_v<T, Bytes>)
    bytes = held;
  else
    bytes = std::make_shared<const Bytes>(to_bytes(*held));
  auto artifact = std::make_shared<Artifact>(sha256(*bytes), bytes->size(), Loader());
  artifact->bytes_ = std::move(bytes);
  artifact->hold(held);
  return artifact;
}

template <class T>
const T& Artifact::get() const {
  const std::lock_guard lock(mutex_);
  if (value_) {
    expect_type(typeid(T));
    return *static_cast<const T*>(value_.get());
  }
  const std::shared_ptr<const Bytes> bytes = bytes_ || !loader_ ? std::exchange(bytes_, nullptr) : load();
  if (!bytes) throw Error(ExitCode::Internal, "artifact " + digest_.hex() + " is not there any more");
  if constexpr (std::is_same_v<T, Bytes>)
    return hold<T>(bytes);
  else
    return hold(std::make_shared<const T>(from_bytes<T>(*bytes)));
}

template <class T>
const T& Artifact::hold(std::shared_ptr<const T> value) const {
  value_ = value;
  type_ = typeid(T);
  if constexpr (!std::is_same_v<T, Bytes>)
    encode_ = [](const void* held) { return to_bytes(*static_cast<const T*>(held)); };
  return *value;
}

}  // namespace skinforge
