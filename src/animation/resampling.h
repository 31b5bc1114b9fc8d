#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace skinforge {

/// The regular grid on which a clip is compared and completed (SkinMixer Sec. 8.1): steps of equal length,
/// the nearest to 1 / rate that divides the duration, so the last frame lies exactly on it. A clip without
/// duration has one frame.
struct ClipFrames {
  double duration;    ///< seconds
  std::size_t count;  ///< at least 1

  ClipFrames(double seconds, double rate_hz)
      : duration(seconds),
        count(seconds > 0 ? static_cast<std::size_t>(std::max(1L, std::lround(seconds * rate_hz))) + 1 : 1) {}
  double time(std::size_t frame) const {
    return frame + 1 == count ? duration
                              : duration * static_cast<double>(frame) / static_cast<double>(count - 1);
  }
  /// Seconds between frames; 1 for a single frame, so that it may be divided by.
  double step() const { return count > 1 ? duration / static_cast<double>(count - 1) : 1; }
};

}  // namespace skinforge
