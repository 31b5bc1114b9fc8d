#pragma once

#include <cstddef>
#include <functional>

namespace skinforge {

/// Calls `body(i)` for every i in [0, count), on as many threads as `set_thread_limit` allows. Each call must
/// write only what belongs to its own i, so that results do not depend on the number of threads; no sums
/// across calls. The exception of the lowest i is rethrown.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Same, in consecutive chunks: `body(begin, end)`. For cheap bodies.
void parallel_chunks(std::size_t count, std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& body);

/// Threads for the whole process (-j). At least 1; default: one per core.
void set_thread_limit(std::size_t threads);

}  // namespace skinforge
