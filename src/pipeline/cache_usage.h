#pragma once

#include <cstdint>
#include <string>

#include "pipeline/blob_store.h"

namespace skinforge {

/// What a cache was good for. Information only; lost or damaged it counts from 0 again.
struct CacheUsage {
  std::uint64_t builds = 0;
  std::uint64_t hits = 0;    ///< stages taken from the cache
  std::uint64_t runs = 0;    ///< stages that ran, well or badly
  double saved_seconds = 0;  ///< wall time that the hits took when they ran
  double spent_seconds = 0;  ///< of the runs

  /// In [0, 1]; 0 where nothing was asked for.
  double hit_rate() const { return hits + runs == 0 ? 0 : double(hits) / double(hits + runs); }
  CacheUsage& operator+=(const CacheUsage& other);
};

/// Adds one build of a session to what the cache knows. A file for each session, so that builds of other
/// recipes at the same time do not lose counts; two builds of one recipe may.
void note_usage(BlobStore& store, const std::string& session, const CacheUsage& usage);

/// Of all sessions.
CacheUsage total_usage(const BlobStore& store);

}  // namespace skinforge
