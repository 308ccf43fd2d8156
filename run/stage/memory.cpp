// Counts the planes of all stages from their plans, before any plane is allocated.
#include "run/stage/memory.h"

#include "core/plane.h"
#include "core/quantities.h"
#include "core/resample.h"
#include "lang/calculus/derivative.h"
#include "lang/calculus/diffusion.h"
#include "lang/lower/lower.h"
#include "run/domain/free_memory.h"
#include "run/stage/stage_time.h"
#include "solvers/advance.h"
#include "solvers/error_estimate.h"
#include "solvers/scheme.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace cascade {

std::string describe_sides(const Grid& grid) {
    std::string sides = fmt::format("{} × {}", grid.width, grid.height);
    if (grid.depth > 1) sides += fmt::format(" × {}", grid.depth);
    return sides;
}

namespace {

/// Returns the number of planes that operations between the passes of a plan need. A constraint
/// needs the vectors of its solver and the temporaries of its plans. A convolution needs the waves
/// of its operand and of its kernel, on a grid that is at most twice as wide along each axis.
std::uint64_t planes_between_passes(const StepPlan& plan, const Grid& grid) {
    std::uint64_t planes = 0;
    for (const Pass& pass : plan.passes) {
        for (const Solve& solve : pass.solves) {
            planes += 6 + solve.whole->temporaries + solve.linear->temporaries + 2;
            if (solve.parts) planes += solve.parts->temporaries + 2 * solve.parts->result_count;
        }
        for (std::size_t k = 0; k < pass.convolutions.size(); ++k) {
            std::uint64_t waves = 2;
            if (grid.width > 1 && grid.boundary.x != Boundary::periodic) waves *= 2;
            if (grid.height > 1 && grid.boundary.y != Boundary::periodic) waves *= 2;
            if (grid.depth > 1 && grid.boundary.z != Boundary::periodic) waves *= 2;
            planes += waves;
        }
    }
    return planes;
}

/// Returns the number of planes that exist only while a stage runs: temporaries of passes, all
/// registers except the old step, and the copy of the species for replays.
std::uint64_t planes_while_running(const Program& program, std::uint32_t k, StagePlans& plans,
                                   const Grid& grid) {
    const Stage& stage = program.stages[k];
    const std::uint32_t species = program.system_of(k).species_count();
    Scheme scheme = make_scheme(stage.time.solver, species, steps_by_item(stage));
    if (stage.time.automatic_speed && !scheme.error_register) {
        scheme = with_error_estimate(std::move(scheme));
    }
    std::uint32_t temporaries = plans.start(k).temporaries;
    std::uint64_t between_passes = 0;
    for (const SweepForm& form : scheme.forms) {
        const StepPlan& plan = plans.sweep(k, form);
        temporaries = std::max(temporaries, plan.temporaries);
        between_passes += planes_between_passes(plan, grid);
    }
    // Step-invariants stay in memory. Their computation may need more temporaries than a step does.
    const StepPlan& step_invariants = plans.step_invariants(k);
    temporaries = std::max(temporaries, step_invariants.temporaries) + step_invariants.result_count;
    Schedule schedule;
    schedule.judges_all = judges_all_steps(stage);
    const bool keeps = keeps_copy(schedule, species, grid, program.domain.precision);
    std::uint64_t planes =
        between_passes + temporaries + std::uint64_t{scheme.registers - (keeps ? 0 : 1)} * species;
    if (!is_semi_implicit(stage.time.solver)) return planes;
    // Factors of diffusion that change are written to planes.
    for (const SpeciesDiffusion& diffusion : diffusion_of(program, k)) {
        planes += std::count_if(diffusion.begin(), diffusion.end(), [&](const Formula& factor) {
            return !factor.nodes.empty() && changes_in_time(program, k, factor);
        });
    }
    return planes;
}

/// Returns the number of elements of a plane. Adds the elements of the planes of coarser grids that
/// exist at the same time, which belong to the grid that runs and to the previous grid.
std::int64_t plane_size(const Program& program, const Grid& grid) {
    std::int64_t size = PlaneLayout(grid).size(), coarse = 0;
    for (const Stage& stage : program.stages) {
        if (stage.time.coarse == 1) continue;
        const std::int64_t pair =
            PlaneLayout(coarser(grid, 2)).size() +
            (stage.time.coarse > 2 ? PlaneLayout(coarser(grid, 4)).size() : 0);
        coarse = std::max(coarse, pair);
    }
    return size + coarse;
}

/// Returns the number of planes that are needed for a short time to choose steps and stages: for
/// computing bounds, or for estimating an eigenvalue (two planes for each species and four vectors
/// in double precision).
std::uint64_t planes_to_choose(const Program& program, std::uint32_t stage,
                               const ModelFacts* model) {
    if (program.domain.model && model == nullptr) return 0;
    const StageTime& time = program.stages[stage].time;
    if (!is_stabilised(time.solver) && !(time.automatic_speed && !is_adaptive(time.solver)))
        return 0;
    const auto bound = jacobian_bound(program, stage, model);
    if (!bound) return std::uint64_t{10} * program.system_of(stage).species_count();
    const Formula* const formulas[] = {&bound->whole, &bound->reaction};
    const StepPlan plan = plan_view(program, formulas, stage);
    return std::uint64_t{plan.temporaries} + plan.result_count;
}

}  // namespace

double memory_of(const Program& program) {
    StagePlans plans(program, {Materialise::when_cheaper, false, true});
    return memory_of(program, plans);
}

double memory_of(const Program& program, StagePlans& plans, const ModelFacts* model) {
    const Grid& grid = model ? model->grid : program.domain.grid;
    // In all stages, every species, its copy for `until: steady` and every varying parameter are
    // counted, because later stages and pictures may read any of them.
    std::uint64_t planes = 4;
    for (const Stage& stage : program.stages) {
        const System& system = program.systems[stage.system];
        if (system.cells) continue;  // The number of crawling cells is known only during the run.
        for (const ItemId item : system.items()) {
            if (system.is_species(item)) {
                planes += stage.time.steady ? 2 : 1;
            } else if (!stage.uniform[item]) {
                planes += 1;
            }
        }
    }
    std::uint64_t while_running = 0;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (program.system_of(k).cells) continue;
        while_running = std::max(while_running, planes_while_running(program, k, plans, grid) +
                                                    planes_to_choose(program, k, model));
    }
    planes += while_running;
    if (program.domain.surface) planes += metric_plane_count;
    if (program.domain.mask) planes += 2;  // A mask needs a plane of words and a plane of bytes.
    return static_cast<double>(planes) * static_cast<double>(plane_size(program, grid)) *
           static_cast<double>(bytes_of(program.domain.precision));
}

Result<void> check_memory(const Grid& grid, double needed, std::uint64_t limit) {
    const auto fails = [&](double bytes, std::string_view what) {
        const std::string who = grid.linked
                                    ? "the cells of this model need"
                                    : fmt::format("a grid of {} cells needs", describe_sides(grid));
        return failure(fmt::format("{} {} for this script, but {} {}", who, with_unit(needed, "B"),
                                   with_unit(bytes, "B"), what),
                       grid.linked ? "use fewer cells" : "use a smaller grid");
    };
    if (limit > 0 && needed > static_cast<double>(limit)) {
        return fails(static_cast<double>(limit), "are the limit (--limit-memory)");
    }
    const auto free = static_cast<double>(available_memory());
    if (free > 0 && needed > free) return fails(free, "are free");
    return {};
}

}  // namespace cascade
