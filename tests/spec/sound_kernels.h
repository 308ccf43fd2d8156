// Lowering of whole programs, for the tests of this folder.
#pragma once

#include "lang/program/program.h"

namespace cascade {

/// Lowers all formulas of a checked script. The test fails if a kernel is not sound.
void expect_sound_kernels(const Program& program);

}  // namespace cascade
