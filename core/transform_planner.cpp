// The one mutex of the process: solvers/ and measure/ both make plans.
#include "core/transform_planner.h"

namespace cascade {

std::mutex& transform_planner() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace cascade
