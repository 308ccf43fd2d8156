// Recognises stages whose steps must not be shortened: cellular automata, and rates that read the
// length of a step.
#pragma once

#include "run/simulation/stage_view.h"

#include <cstdint>

namespace cascade {

/// Whether the rates depend on the index or the length of a step, or on random numbers. If so,
/// shorter steps would change the result of the stage.
bool knows_its_steps(const Program& program, std::uint32_t stage);

/// Whether a step of this stage computes exactly the next values. This is so in a cellular
/// automaton with the rate f - u and steps of 1, or with the rate (f - u) / speed. The steps of
/// such a stage are never too long. All values of a cellular automaton are whole numbers. In any
/// other stage, only a bound of a species can make all values whole numbers.
bool is_exact_map(const StageView& view);

}  // namespace cascade
