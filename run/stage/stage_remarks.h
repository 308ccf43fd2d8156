// What happened in a stage, in words: where its result is not what one would take it for.
#pragma once

#include "lang/program/program.h"
#include "run/stage/stage_state.h"

#include <string>

namespace cascade {

/// One sentence about a stage that has ended, or nothing. Said of any stage: that it is frozen in
/// all cells, that it ended even, and that its `until` never came true. Said of the last one that
/// takes a step (`is_last`), since others are often cut short on purpose: that its pattern was
/// still growing, or dying out. Also of any stage: that 'frozen', which differs from cell to cell,
/// is true nowhere, and that cells differ by errors of steps of chosen length alone. `inside` says
/// which cells count; nullptr: all.
std::string describe_end(const Stage& stage, const System& system, const StageState& state,
                         bool is_last, const Mask* inside);

}  // namespace cascade
