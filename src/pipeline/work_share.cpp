#include "pipeline/work_share.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace skinforge {

namespace {
// What the process holds in memory now; 0 where the system does not say.
std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(file >> all >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}
}  // namespace

WorkShare::WorkShare(std::size_t jobs, std::uint64_t memory_bytes)
    : jobs_(std::max<std::size_t>(jobs, 1)), memory_bytes_(memory_bytes) {}

// The first one may always, so that a budget that is too small makes a build slow, not endless.
bool WorkShare::may_start() const {
  if (running_ == 0) return true;
  return running_ < jobs_ && (memory_bytes_ == 0 || resident_bytes() <= memory_bytes_);
}

WorkShare::Held WorkShare::take_turn() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return may_start(); });
  ++running_;
  return Held([this] {
    {
      const std::lock_guard guard(mutex_);
      --running_;
    }
    changed_.notify_all();
  });
}

WorkShare::Held WorkShare::claim(const Digest& key) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !claimed_.contains(key); });
  claimed_.insert(key);
  return Held([this, key] {
    {
      const std::lock_guard guard(mutex_);
      claimed_.erase(key);
    }
    changed_.notify_all();
  });
}

}  // namespace skinforge
