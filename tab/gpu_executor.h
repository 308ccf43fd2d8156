// Takes steps on the GPU of the browser, by WebGPU.
#pragma once

#include "solvers/executor.h"

#include <functional>
#include <string>

namespace cascade {

/// Where the steps of a stage are taken.
struct EngineOfSteps {
    bool is_gpu = false;
    std::string about;  ///< The name of the GPU, or the reason why it does not take the steps.

    friend bool operator==(const EngineOfSteps&, const EngineOfSteps&) = default;
};

/// Makes executors on the GPU of the browser. A stage runs on the thread of the page if it has
/// fewer than 256 × 256 cells, if reason_against_wgsl() gives a reason, or if there is no GPU with
/// the right bits. If the GPU fails later, the executor repeats the steps since its values were
/// last read, and continues on the thread. `tell` is told where steps are taken, whenever this may
/// have changed.
MakeExecutor on_gpu(std::function<void(const EngineOfSteps&)> tell);

}  // namespace cascade
