// Measures the limits of this machine: the speed of arithmetic, the bandwidths of its caches and
// memory, and the time for a barrier of threads.
//
// The measurements use kernels compiled in the same way as kernels of steps, with the same vector
// width and the same strict arithmetic, in which products and sums are separate operations.
#pragma once

#include "core/precision.h"
#include "core/result.h"
#include "ir/backend.h"

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

struct MachineLimits {
    struct Memory {
        std::string name;  ///< Such as "first-level cache" or "memory".
        /// The capacity that all threads share. Infinite for main memory.
        double bytes = 0;
        /// The bandwidth, measured with the triad a + s · b, which reads two planes and writes one
        /// plane.
        double bytes_per_second = 0;
    };
    int threads = 1;
    double operations = 0;         ///< Sums and products per second, over all lanes and threads.
    double divisions = 0;          ///< Divisions per second, over all lanes and threads.
    double meeting = 0;            ///< Seconds for a barrier. 0 with one thread.
    std::vector<Memory> memories;  ///< The caches and the main memory, the first-level cache first.

    /// Returns the memory that a step reads if its data have this size: the cache with enough room
    /// that is nearest to the processor, or main memory if no cache has enough room.
    const Memory& home_of(double bytes) const;
};

/// Measures the limits, which takes some tenths of a second. Fails if a kernel cannot be compiled
/// or if `cancel` is set during the measurement. Throws std::bad_alloc.
Result<MachineLimits> measure_limits(Backend& backend, Precision precision, int threads,
                                     const std::atomic<bool>& cancel);

}  // namespace cascade
