// Restricts and refines whole states of stages by core/resample; sides that vary are restricted,
// too. Steps on coarser grids are neither kept nor observed.
#include "run/simulation/coarse_start.h"

#include "core/resample.h"
#include "run/simulation/regridded_state.h"
#include "run/simulation/stage_run.h"
#include "run/simulation/stage_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {

namespace {

constexpr std::int64_t most_steps = 1'000'000'000;

Field restricted_field(const Field& fine, const Grid& fine_grid, const Grid& coarse_grid) {
    return fine.visit(
        [&](const auto& plane) { return Field(restricted(plane, fine_grid, coarse_grid)); });
}

/// The cells beside a side of an axis as a grid of their own, in the same order.
Grid face_of(const Grid& grid, std::size_t axis) {
    return {axis == 0 ? grid.height : grid.width, axis == 2 ? grid.height : grid.depth};
}

/// Values of a side on a coarser grid: means along the side.
std::shared_ptr<const SideValues> restricted(const SideValues& fine, const Grid& fine_grid,
                                             const Grid& coarse_grid, std::size_t axis) {
    const Grid face = face_of(fine_grid, axis), coarse_face = face_of(coarse_grid, axis);
    Plane<double> numbers{PlaneLayout(face)};
    for (std::int64_t j = 0; j < face.height; ++j) {
        std::copy_n(fine.numbers.begin() + j * face.width, face.width, numbers.row(j));
    }
    const Plane<double> means = restricted(numbers, face, coarse_face);
    SideValues coarse;
    for (std::int64_t j = 0; j < coarse_face.height; ++j) {
        coarse.numbers.insert(coarse.numbers.end(), means.row(j), means.row(j) + coarse_face.width);
    }
    return std::make_shared<const SideValues>(std::move(coarse));
}

/// The same program on a grid whose cells are `times` as wide. The stage takes times² as many
/// steps, or as much time, as on the fine grid, because the time that a pattern needs grows with
/// the square of its lengths.
Program on_coarser_grid(const Program& program, std::uint32_t stage, std::int64_t times) {
    Program result = program;
    result.domain.grid = coarser(program.domain.grid, times);
    Stage& own = result.stages[stage];
    own.time.coarse = 1;
    own.iterations = std::min(most_steps, own.iterations * times * times);
    if (own.time.duration) *own.time.duration *= static_cast<double>(times * times);
    if (own.time.duration_in_steps) *own.time.duration_in_steps *= times * times;
    return result;
}

/// An earlier stage's values on a coarser grid, for starting values.
StageState restricted(const StageState& fine, const Grid& fine_grid, const Grid& coarse_grid) {
    return regridded(fine, {coarse_grid.spacing,
                            [&](const Field& plane) {
                                return restricted_field(plane, fine_grid, coarse_grid);
                            },
                            [&](const SideValues& values, std::size_t side) {
                                return restricted(values, fine_grid, coarse_grid, side / 2);
                            }});
}

/// Files on a coarser grid.
InputFiles restricted(const InputFiles& fine, const Grid& fine_grid, const Grid& coarse_grid) {
    return fine.mapped(
        [&](const Field& plane) { return restricted_field(plane, fine_grid, coarse_grid); });
}

/// Takes the species of a stage from the same stage on a grid twice as coarse. Frozen cells keep
/// their starting values.
void take_refined(StageState& fine, const Grid& fine_grid, StageState& coarse,
                  const Grid& coarse_grid) {
    for (std::size_t s = 0; s < fine.species.size(); ++s) {
        const SideRules sides =
            coarse.sides.empty() ? SideRules(coarse_grid.boundary) : coarse.sides[s];
        Field values = coarse.species[s].visit(
            [&](auto& plane) { return Field(refined(plane, coarse_grid, fine_grid, sides)); });
        if (!fine.frozen.empty()) {
            values.visit([&]<typename Number>(Plane<Number>& plane) {
                const Plane<Number>& old = fine.species[s].plane<Number>();
                for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
                    for (std::int64_t i = 0; i < plane.layout().width; ++i) {
                        if (fine.frozen.row(row)[i]) plane.row(row)[i] = old.row(row)[i];
                    }
                }
            });
        }
        fine.species[s] = std::move(values);
    }
}

/// A stage on one of its coarser grids.
struct CoarseStage {
    std::unique_ptr<Environment> environment;
    std::vector<StageState> states;
};

CoarseStage on_coarser_grid(const Environment& fine, std::span<const StageState> states,
                            std::uint32_t stage, std::int64_t times) {
    CoarseStage coarse{std::make_unique<Environment>(), std::vector<StageState>(states.size())};
    Environment& here = *coarse.environment;
    here.script = fine.script;
    here.own_program = on_coarser_grid(*fine.program, stage, times);
    here.program = &*here.own_program;
    here.progress_note = fmt::format(", cells {} times as wide", times);
    here.grid = here.program->domain.grid;
    here.threads = fine.threads;
    here.plans = std::make_unique<StagePlans>(*here.program, fine.plans->options());
    here.kernels = std::make_unique<KernelMaker>(here.grid, fine.kernels->stepper(),
                                                 fine.kernels->starts_interpreted(), nullptr);
    here.team = std::make_unique<Team>(1);
    here.files = restricted(fine.files, fine.grid, here.grid);
    for (std::uint32_t earlier = 0; earlier < stage; ++earlier) {
        coarse.states[earlier] = restricted(states[earlier], fine.grid, here.grid);
    }
    return coarse;
}

}  // namespace

Result<StageEnd> run_on_coarser_grids(const Environment& environment, std::span<StageState> states,
                                      std::uint32_t stage, RunControl& control) {
    const Keeping never;
    std::optional<CoarseStage> before;
    for (std::int64_t times = environment.stage(stage).time.coarse; times > 1; times /= 2) {
        CoarseStage coarse = on_coarser_grid(environment, states, stage, times);
        const Environment& here = *coarse.environment;
        const auto note = [&](Failure failure) {
            failure.message += fmt::format(" (on the grid with cells {} times as wide)", times);
            return tl::unexpected(std::move(failure));
        };
        if (auto started = start_stage(here, coarse.states, stage); !started)
            return note(started.error());
        if (before) {
            take_refined(coarse.states[stage], here.grid, before->states[stage],
                         before->environment->grid);
        }
        auto end = StageRun(here, coarse.states, stage, never)
                       .advance(here.stage(stage).iterations, control, {}, 0);
        if (!end) return note(end.error());
        if (*end == StageEnd::cancelled) return end;
        before = std::move(coarse);
    }
    take_refined(states[stage], environment.grid, before->states[stage], before->environment->grid);
    return StageEnd::finished;
}

}  // namespace cascade
