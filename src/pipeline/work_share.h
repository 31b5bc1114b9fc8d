#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>

#include "base/hash.h"

namespace skinforge {

/// What engines that work side by side share, so that they are one pool: how many stages run at a time, as
/// with make's job server, and which are being made, so that none is made twice. Thread-safe.
class WorkShare {
 public:
  /// At most `jobs` stages at a time. `memory_bytes`: while the process holds more than that, no stage starts
  /// beside another; 0: it may hold what it likes.
  explicit WorkShare(std::size_t jobs, std::uint64_t memory_bytes = 0);

  /// Something that is held until it goes.
  class Held {
   public:
    explicit Held(std::function<void()> release) : release_(std::move(release)) {}
    Held(Held&& other) noexcept : release_(std::exchange(other.release_, nullptr)) {}
    Held& operator=(Held&&) = delete;
    ~Held() {
      if (release_) release_();
    }

   private:
    std::function<void()> release_;
  };

  /// Waits until a stage may run. Whoever holds a turn must not wait for a key.
  Held take_turn();
  /// Waits until nobody else makes the results of this key.
  Held claim(const Digest& key);

 private:
  bool may_start() const;

  std::size_t jobs_;
  std::uint64_t memory_bytes_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t running_ = 0;
  std::set<Digest> claimed_;
};

}  // namespace skinforge
