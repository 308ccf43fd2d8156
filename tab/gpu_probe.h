// Finds out how the GPU of the browser computes.
#pragma once

#include "device/prelude.h"

#include <optional>
#include <string>

namespace cascade {

struct GpuProbe {
    /// The form of programs whose results have the right bits. Empty if there is none.
    std::optional<Flushing> flushing;
    /// The first operation with other bits.
    std::string fault;
};

/// Waits in its first call. host_gpu_open() must have succeeded. The right bits are those of exact
/// modules (wasm/kernel_module.h), because the interpreter of a tab keeps denormal numbers.
const GpuProbe& probed_gpu();

}  // namespace cascade
