// What this machine can do at most, measured: arithmetic, the bandwidth of its caches and of its
// memory, meetings of threads.
//
// They are measured by kernels of our own, compiled as those of steps are, so that they use the
// vectors that steps use and the strict arithmetic that steps do: products and sums apart.
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
        double bytes = 0;             ///< That it holds, for all threads; infinite for memory.
        double bytes_per_second = 0;  ///< Of a triad, a + s · b: two planes read, one written.
    };
    int threads = 1;
    double operations = 0;  ///< A second: products and sums by turns, in all lanes of all threads.
    double divisions = 0;   ///< A second.
    double meeting = 0;     ///< Seconds; 0 for one thread.
    std::vector<Memory> memories;  ///< The nearest first, at last memory itself.

    /// The nearest that holds so many bytes.
    const Memory& home_of(double bytes) const;
};

/// Measures for some tenths of a second. Fails where a kernel cannot be compiled, and where
/// `cancel` is set meanwhile. Throws std::bad_alloc.
Result<MachineLimits> measure_limits(Backend& backend, Precision precision, int threads,
                                     const std::atomic<bool>& cancel);

}  // namespace cascade
