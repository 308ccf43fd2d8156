// The result on each grid is refined for the next finer grid (core/resample). Steps on coarser
// grids are neither saved nor observed.
#include "run/simulation/coarse_start.h"

#include "core/resample.h"
#include "run/simulation/other_cells.h"
#include "run/simulation/stage_run.h"
#include "run/simulation/stage_start.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {

namespace {

constexpr std::int64_t most_steps = 1'000'000'000;

/// Prepares a stage for its start on a grid whose cells are `times` times as wide. The stage takes
/// times² as many steps (or times² as much time) as on the fine grid, because the time that a
/// pattern needs grows with the square of its lengths.
StagesInOtherCells at_start_of(const Environment& fine, std::span<const StageState> states,
                               std::uint32_t stage, std::int64_t times) {
    Program program = coarser_program(fine.script, *fine.program, times);
    Stage& own = program.stages[stage];
    own.time.coarse = 1;
    own.time.every = 0;
    own.iterations = std::min(most_steps, fine.stage(stage).iterations * times * times);
    if (own.time.duration) *own.time.duration *= static_cast<double>(times * times);
    if (own.time.duration_in_steps) *own.time.duration_in_steps *= times * times;
    StagesInOtherCells coarse{on_coarser_grid(fine, std::move(program), nullptr),
                              std::vector<StageState>(states.size())};
    for (std::uint32_t earlier = 0; earlier < stage; ++earlier)
        coarse.states[earlier] = on_grid(states[earlier], fine.grid, coarse.environment->grid);
    return coarse;
}

/// Gives a stage the species of the same stage on a grid whose cells are twice as wide. Frozen
/// cells keep their starting values.
void take_refined(FieldState& fine, const Grid& fine_grid, FieldState& coarse,
                  const Grid& coarse_grid) {
    for (std::size_t s = 0; s < fine.species.size(); ++s) {
        const SideRules sides =
            coarse.sides.empty() ? SideRules(coarse_grid.boundary) : coarse.sides[s];
        Field values = coarse.species[s].visit(
            [&](auto& plane) { return Field(refined(plane, coarse_grid, fine_grid, sides)); });
        keep_frozen(values, fine.frozen, fine.species[s]);
        fine.species[s] = std::move(values);
    }
}

}  // namespace

Result<StageEnd> run_on_coarser_grids(const Environment& environment, std::span<StageState> states,
                                      std::uint32_t stage, RunControl& control) {
    const Keeping never;
    std::optional<StagesInOtherCells> before;
    for (std::int64_t times = environment.stage(stage).time.coarse; times > 1; times /= 2) {
        StagesInOtherCells coarse = at_start_of(environment, states, stage, times);
        const Environment& here = *coarse.environment;
        if (auto started = start_stage(here, coarse.states, stage); !started) {
            Failure why = started.error();
            why.message += note_of_cells(*here.program);
            return tl::unexpected(std::move(why));
        }
        if (before) {
            take_refined(coarse.states[stage].fields(), here.grid, before->states[stage].fields(),
                         before->environment->grid);
        }
        auto end = StageRun(here, coarse.states, stage, never)
                       .advance(here.stage(stage).iterations, control, {});
        if (!end || *end == StageEnd::cancelled) return end;
        before = std::move(coarse);
    }
    take_refined(states[stage].fields(), environment.grid, before->states[stage].fields(),
                 before->environment->grid);
    return StageEnd::finished;
}

}  // namespace cascade
