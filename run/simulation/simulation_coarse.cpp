// Stages that start on coarser grids.
#include "ir/interpreter.h"
#include "run/simulation/coarse_start.h"
#include "run/simulation/simulation_implementation.h"

namespace cascade {

std::unique_ptr<Simulation> Simulation::Implementation::on_coarser_grid(std::uint32_t k,
                                                                        std::int64_t times) const {
    std::unique_ptr<Simulation> simulation(new Simulation);
    Implementation& coarse = *simulation->self_;
    coarse.script = script;
    coarse.own_program = cascade::on_coarser_grid(*program, k, times);
    coarse.program = &*coarse.own_program;
    coarse.plans = std::make_unique<StagePlans>(*coarse.program, plans->options());
    coarse.grid = coarse.program->domain.grid;
    coarse.threads = threads;
    coarse.interpreter = make_interpreter();
    coarse.stepper = stepper;
    coarse.starts_interpreted = starts_interpreted;
    coarse.has_expected = true;  // Later stages are no business of a coarser grid's.
    coarse.team = std::make_unique<Team>(1);
    coarse.files = restricted(files, grid, coarse.grid);
    coarse.states.resize(states.size());
    for (std::uint32_t earlier = 0; earlier < k; ++earlier) {
        coarse.states[earlier] = restricted(states[earlier], grid, coarse.grid);
    }
    coarse.progress_note = fmt::format(", cells {} times as wide", times);
    return simulation;
}

Result<StageEnd> Simulation::Implementation::run_on_coarser_grids(std::uint32_t k,
                                                                  RunControl& control) {
    std::unique_ptr<Simulation> before;
    for (std::int64_t times = stage(k).time.coarse; times > 1; times /= 2) {
        std::unique_ptr<Simulation> coarse = on_coarser_grid(k, times);
        const auto note = [&](Failure failure) {
            failure.message += fmt::format(" (on the grid with cells {} times as wide)", times);
            return tl::unexpected(std::move(failure));
        };
        if (auto started = coarse->start_stage(k); !started) return note(started.error());
        if (before) {
            take_refined(coarse->self_->states[k], coarse->grid(), before->self_->states[k],
                         before->grid());
        }
        auto end = coarse->advance_stage(k, coarse->program().stages[k].iterations, control, {});
        if (!end) return note(end.error());
        if (*end == StageEnd::cancelled) return end;
        before = std::move(coarse);
    }
    take_refined(states[k], grid, before->self_->states[k], before->grid());
    return StageEnd::finished;
}

}  // namespace cascade
