// The present state of a simulation on a plane, seen on a finer grid.
#pragma once

#include "lang/program/program.h"
#include "run/simulation/environment.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

/// Values between cells lie on the curves of core/between_cells.h. The grid is a plane without a
/// mask and without a surface, and its stages are of fields.
class FinerView {
public:
    /// Each cell becomes times × times cells, of a line `times`. Throws std::bad_alloc.
    FinerView(const Environment& environment, std::span<const StageState> states,
              std::int64_t times);

    /// Evaluates a formula for pictures, as Simulation::evaluate() does.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;

private:
    Environment environment_;
    std::vector<StageState> states_;
};

}  // namespace cascade
