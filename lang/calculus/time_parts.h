// The parts of a stage's rates and of the rules at its sides that change by themselves, whatever
// the species do.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <vector>

namespace cascade {

struct TimeParts {
    /// The largest parts that read `t` and otherwise only constants. They are the same in all
    /// cells. In u' = exp(-(t - 50)^2) * sx - u this is the exponential.
    std::vector<Formula> of_time;
    /// The largest parts that read `t` and places and are no sums and products of parts that read
    /// one of both: what moves, such as exp(-(x - 5 * t)^2).
    std::vector<Formula> of_places;
};

/// Searches the rates of a stage, its sides and borders, and the sides of definitions.
TimeParts parts_of_time(const Program& program, std::uint32_t stage);

}  // namespace cascade
