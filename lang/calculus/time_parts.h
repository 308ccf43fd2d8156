// Finds the parts of a stage's rates, and of the rules at its sides, that change with time even if
// no species changes.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <vector>

namespace cascade {

struct TimeParts {
    /// The largest parts that read `t` and nothing else but constants. They are the same in all
    /// cells. In u' = exp(-(t - 50)^2) * sx - u the only such part is the exponential.
    std::vector<Formula> of_time;
    /// The largest parts that read both `t` and positions, such as exp(-(x - 5 * t)^2), a pulse
    /// that moves. A sum or product of a part that reads only `t` and a part that reads only
    /// positions is left out.
    std::vector<Formula> of_places;
};

/// Searches the rates of a stage, and the rules at its sides and borders, for species and for
/// definitions.
TimeParts parts_of_time(const Program& program, std::uint32_t stage);

}  // namespace cascade
