// A copy of each problem is told the present number of cells.
#include "tissue/value_runner.h"

#include "core/floating_point.h"
#include "core/links.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cascade {
namespace {

void keep_each_once(std::vector<std::uint32_t>& cells) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

/// These cells and their neighbours.
template <typename Number>
std::vector<std::uint32_t> with_neighbours(std::vector<std::uint32_t> cells,
                                           const LinkTable<Number>& links,
                                           const PlaneLayout& layout) {
    constexpr std::int64_t lanes = LinkTable<Number>::slice_cells;
    const std::int64_t slices_in_row = (layout.width + lanes - 1) / lanes;
    for (std::size_t k = 0, count = cells.size(); k < count; ++k) {
        const std::int64_t row = cells[k] / layout.width, column = cells[k] % layout.width;
        const std::int64_t slice = row * slices_in_row + column / lanes;
        for (std::int64_t entry = links.starts[slice]; entry < links.starts[slice + 1]; ++entry) {
            if ((links.filled[entry] >> column % lanes & 1) == 0) continue;
            const std::int64_t at = links.target(lanes * entry + column % lanes);
            const std::int64_t other = at / layout.stride;
            cells.push_back(
                static_cast<std::uint32_t>(other * layout.width + (at - layout.row_start(other))));
        }
    }
    keep_each_once(cells);
    return cells;
}

using Rows = std::vector<std::int64_t>;

/// The rows in which these cells are, each once. The cells are in ascending order.
Rows rows_of(std::span<const std::uint32_t> cells, std::int64_t width) {
    Rows rows;
    for (const std::uint32_t cell : cells) {
        if (rows.empty() || rows.back() != cell / width) rows.push_back(cell / width);
    }
    return rows;
}

/// The rows that each pass must compute for the values of some cells: a pass may read the links of
/// what the passes before it write. Empty if all rows are needed.
std::vector<Rows> rows_of_passes(const StepProblem& problem, const CellValues& values,
                                 std::span<const std::uint32_t> among) {
    const auto reduces = [](const StepProblem::Pass& pass) { return !pass.reductions.empty(); };
    if (among.empty() || std::any_of(problem.passes.begin(), problem.passes.end(), reduces)) {
        return {};
    }
    const PlaneLayout layout(problem.grid);
    std::vector<std::uint32_t> cells(among.begin(), among.end());
    keep_each_once(cells);
    const bool reads_others = !values.is_of_cell_alone && !values.reads_only_species_of_others;
    std::vector<Rows> rows(problem.passes.size());
    for (std::size_t pass = rows.size(); pass-- > 0;) {
        rows[pass] = rows_of(cells, layout.width);
        if (!reads_others || pass == 0) continue;
        with_number(problem.precision, [&](auto zero) {
            using Number = decltype(zero);
            cells = with_neighbours(std::move(cells), problem.links->table<Number>(), layout);
        });
    }
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
    const std::vector<Rows> rows = rows_of_passes(known.problem, values, among);
    if (rows.empty()) {
        known.runner->run_once(team_, registers, moment);
        return known.results;
    }
    // Few rows are not worth the other threads.
    const FlushDenormals environment;
    PassRunner::Worker worker;
    known.runner->prepare(worker, 0, 1);
    for (std::size_t pass = 0; pass < rows.size(); ++pass) {
        known.runner->bind(worker, 0, pass, registers, moment);
        for (const std::int64_t row : rows[pass]) {
            known.runner->run_cells(worker, 0, {{row, row + 1}});
        }
    }
    return known.results;
}

}  // namespace cascade
