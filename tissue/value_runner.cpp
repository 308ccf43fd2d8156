// A copy of each problem is told the present number of cells.
#include "tissue/value_runner.h"

#include <array>
#include <span>

namespace cascade {

std::vector<Field>& ValueRunner::run(const CellValues& values, std::vector<Field>& state,
                                     std::int64_t cells, const StepMoment& moment) {
    Known& known = known_[values.problem];
    if (!known.runner) {
        known.problem = *values.problem;
        known.runner = std::make_unique<PassRunner>(known.problem);
        for (std::size_t k = 0; k < values.count; ++k) {
            known.results.emplace_back(PlaneLayout(known.problem.grid), known.problem.precision);
        }
    }
    known.problem.cells_inside = cells;
    const std::array<std::span<Field>, 2> registers{state, known.results};
    known.runner->run_once(team_, registers, moment);
    return known.results;
}

}  // namespace cascade
