// Runs a copy of each problem. The copy has the present number of cells.
#include "tissue/value_runner.h"

#include "core/check.h"
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

/// The given cells and their neighbours, in ascending order.
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

using Patches = std::vector<Patch>;

/// The smallest number of patches for which several threads are used. With fewer patches, several
/// threads would save no time.
constexpr std::size_t patches_of_threads = 32;

/// The slices of links that contain these cells. Each result is a patch of one row, and adjacent
/// patches are joined. `cells` is in ascending order.
Patches slices_of(std::span<const std::uint32_t> cells, std::int64_t width) {
    constexpr std::int64_t lanes = PlaneLayout::row_pad;
    Patches slices;
    for (const std::uint32_t cell : cells) {
        const std::int64_t row = cell / width, first = cell % width / lanes * lanes;
        Patch* const last = slices.empty() ? nullptr : &slices.back();
        const bool is_same_row = last != nullptr && last->rows.begin == row;
        if (is_same_row && first <= last->columns.end) {
            last->columns.end = first + lanes;
        } else {
            slices.push_back({{row, row + 1}, {first, first + lanes}});
        }
    }
    return slices;
}

/// The number of the last pass before `reader` that writes a temporary.
std::size_t writer_of(const StepProblem& problem, std::size_t reader, TemporaryId temporary) {
    for (std::size_t pass = reader; pass-- > 0;) {
        for (const StepProblem::Result& result : problem.passes[pass].results) {
            if (result.plane == StepProblem::PlaneRef(temporary)) return pass;
        }
    }
    CHECK(false, "a temporary is written before it is read");
    return 0;
}

/// The patches that each pass must compute if only the values of the cells `among` are needed.
/// Empty if each pass must compute all cells.
std::vector<Patches> patches_of_passes(const StepProblem& problem,
                                       std::span<const std::uint32_t> among) {
    const auto reduces = [](const StepProblem::Pass& pass) { return !pass.reductions.empty(); };
    if (std::any_of(problem.passes.begin(), problem.passes.end(), reduces)) return {};
    const PlaneLayout layout(problem.grid);
    std::vector<std::vector<std::uint32_t>> cells(problem.passes.size());
    cells.back().assign(among.begin(), among.end());
    std::vector<Patches> patches(problem.passes.size());
    for (std::size_t pass = patches.size(); pass-- > 0;) {
        const StepProblem::Pass& reader = problem.passes[pass];
        keep_each_once(cells[pass]);
        patches[pass] = slices_of(cells[pass], layout.width);
        std::vector<std::uint32_t> others;  // The neighbours that links read.
        for (std::size_t k = 0; k < reader.fields.size(); ++k) {
            const auto* const temporary = std::get_if<TemporaryId>(&reader.fields[k]);
            if (temporary == nullptr) continue;
            const bool by_links = reader.read_by_links.empty() || reader.read_by_links[k];
            if (by_links && others.empty()) {
                with_number(problem.precision, [&](auto zero) {
                    others = with_neighbours(cells[pass], problem.links->table<decltype(zero)>(),
                                             layout);
                });
            }
            const std::vector<std::uint32_t>& needed = by_links ? others : cells[pass];
            std::vector<std::uint32_t>& of_writer = cells[writer_of(problem, pass, *temporary)];
            of_writer.insert(of_writer.end(), needed.begin(), needed.end());
        }
    }
    return patches;
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
    if (!among.empty() &&
        !std::equal(among.begin(), among.end(), known.among.begin(), known.among.end())) {
        known.among.assign(among.begin(), among.end());
        known.patches = patches_of_passes(known.problem, among);
    }
    if (among.empty() || known.patches.empty()) {
        known.runner->run_once(team_, registers, moment);
        return known.results;
    }
    const int threads = known.patches.back().size() < patches_of_threads ? 1 : team_.size();
    const auto run_part = [&](int thread) {
        PassRunner::Worker worker;
        known.runner->prepare(worker, thread, threads);
        for (std::size_t pass = 0; pass < known.patches.size(); ++pass) {
            if (pass > 0) team_.barrier();
            known.runner->bind(worker, 0, pass, registers, moment, {});
            const Patches& patches = known.patches[pass];
            const auto count = static_cast<std::int64_t>(patches.size());
            const RowRange own = split_rows(count, thread, threads);
            for (std::int64_t k = own.begin; k < own.end; ++k) {
                known.runner->run_cells(worker, 0, patches[static_cast<std::size_t>(k)]);
            }
        }
    };
    team_.run(run_part, threads);
    return known.results;
}

}  // namespace cascade
