// The mutex for FFTW's planner.
#include "core/transform_planner.h"

namespace cascade {

std::mutex& transform_planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace cascade
