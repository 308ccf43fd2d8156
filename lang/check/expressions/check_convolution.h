// The kernels of convolutions (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

#include <cstdint>

namespace cascade::checking {

/// Checks the parameters that the kernels of a stage's convolutions read. These parameters must be
/// the same in all cells and known before the stage starts.
void check_kernels_of_stage(Workspace& work, std::uint32_t index);

}  // namespace cascade::checking
