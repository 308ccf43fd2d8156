// A copy of each problem is told the present number of cells.
#include "tissue/value_runner.h"

#include "core/floating_point.h"

#include <algorithm>
#include <array>

namespace cascade {
namespace {

/// The rows in which these cells are, each once.
std::vector<std::int64_t> rows_of(std::span<const std::uint32_t> cells, std::int64_t width) {
    std::vector<std::int64_t> rows;
    for (const std::uint32_t cell : cells) rows.push_back(cell / width);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
}

}  // namespace

std::vector<Field>& ValueRunner::run(const CellValues& values, std::vector<Field>& state,
                                     const Tissue& tissue, const StepMoment& moment,
                                     std::span<const std::uint32_t> among) {
    Known& known = known_[values.problem];
    if (!known.runner) {
        known.problem = *values.problem;
        known.runner = std::make_unique<PassRunner>(known.problem);
        for (std::size_t k = 0; k < values.count; ++k) {
            known.results.emplace_back(PlaneLayout(known.problem.grid), known.problem.precision);
        }
    }
    known.problem.cells_inside = static_cast<std::int64_t>(tissue.count());
    const std::array<std::span<Field>, 2> registers{state, known.results};
    if (among.empty() || !values.is_of_cell_alone) {
        known.runner->run_once(team_, registers, moment);
        return known.results;
    }
    // Few rows are not worth the other threads.
    const FlushDenormals environment;
    PassRunner::Worker worker;
    known.runner->prepare(worker, 0, 1);
    const std::vector<std::int64_t> rows = rows_of(among, tissue.layout().width);
    for (std::size_t pass = 0; pass < known.problem.passes.size(); ++pass) {
        known.runner->bind(worker, 0, pass, registers, moment);
        for (const std::int64_t row : rows) {
            known.runner->run_cells(worker, 0, {{row, row + 1}});
        }
    }
    return known.results;
}

}  // namespace cascade
