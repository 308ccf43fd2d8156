// Remarks on a stage whose result may not be what it seems.
#pragma once

#include "lang/program/program.h"
#include "run/stage/stage_state.h"

#include <string>

namespace cascade {

/// One sentence about a stage that has ended, or nothing. Made of any stage: that it is frozen in
/// all cells, that it ended even, that its `until` never came true, that a `frozen` which differs
/// from cell to cell is true nowhere, and that cells differ only by the errors of chosen steps.
/// Made of the last stage that takes a step (`is_last`), since earlier ones are often cut short on
/// purpose: that its pattern was still growing, or dying out. `inside` says which cells count;
/// nullptr: all.
std::string describe_end(const Stage& stage, const System& system, const StageState& state,
                         bool is_last, const Mask* inside);

}  // namespace cascade
