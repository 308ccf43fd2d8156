// Measured limits of this machine: arithmetic, the bandwidths of its caches and of its memory, and
// barriers of threads.
//
// They are measured with our own kernels, compiled like those of steps, so that they use the same
// vectors and the same strict arithmetic: products and sums are separate operations.
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
        std::string name;             ///< "first-level cache", …, "memory".
        double bytes = 0;             ///< Capacity available to all threads; infinite for memory.
        double bytes_per_second = 0;  ///< For a triad, a + s · b: two planes read, one written.
    };
    int threads = 1;
    double operations = 0;         ///< Sums and products per second, of all lanes and threads.
    double divisions = 0;          ///< Per second.
    double meeting = 0;            ///< Seconds of a barrier; 0 for one thread.
    std::vector<Memory> memories;  ///< From the nearest to main memory.

    /// The nearest level that holds `bytes`.
    const Memory& home_of(double bytes) const;
};

/// Takes some tenths of a second. Fails if a kernel cannot be compiled, and if `cancel` is set
/// meanwhile. Throws std::bad_alloc.
Result<MachineLimits> measure_limits(Backend& backend, Precision precision, int threads,
                                     const std::atomic<bool>& cancel);

}  // namespace cascade
