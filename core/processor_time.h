// The processor time of this process.
#pragma once

#include <ctime>

namespace cascade {

/// Seconds that all threads of this process have used so far. Signal handlers may call this
/// function.
inline double processor_seconds() {
    timespec now = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace cascade
