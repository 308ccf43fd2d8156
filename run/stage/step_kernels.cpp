// Warns of kernels that are interpreted.
#include "run/stage/step_kernels.h"

#include <fmt/format.h>

namespace cascade {

void StepKernels::warn(const Failure& refusal, RunControl& control) {
    has_refused_ = true;
    if (!control.warn || !said_.insert(refusal.message).second) return;
    control.warn(
        fmt::format("stage '{}' is interpreted, which is slow: {}", stage_, refusal.message));
}

}  // namespace cascade
