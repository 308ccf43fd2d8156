// How the kernels of a run become runnable.
#include "run/simulation/simulation_implementation.h"

#include <algorithm>
#include <utility>

namespace cascade {

void StepKernels::warn(const Failure& refusal, RunControl& control) {
    if (!control.warn || !said_.insert(refusal.message).second) return;
    control.warn(
        fmt::format("stage '{}' is interpreted, which is slow: {}", stage_, refusal.message));
}

Compile Simulation::Implementation::compiled(std::uint32_t k, StepKernels& kernels,
                                             RunControl& control) const {
    using When = TieredBackend::When;
    return [this, &kernels, &control,
            when = is_long(k) ? When::now : When::when_used](const CellKernel& kernel) {
        kernels.identify(kernel);
        if (runs_meanwhile()) {
            KernelPointer begun = stepper->begin(kernel, grid.stencil(), when);
            kernels.add(begun);
            return begun;
        }
        auto made = stepper->compile(kernel, grid.stencil());
        if (made) return *made;
        kernels.warn(made.error(), control);
        return *interpreter->compile(kernel, grid.stencil());
    };
}

void Simulation::Implementation::warn_of_refused(RunControl& control) {
    for (auto& [k, kernels] : unsettled) kernels.warn_of_refused(control);
    std::erase_if(unsettled,
                  [](const auto& of_stage) { return !of_stage.second.is_provisional(); });
}

void Simulation::settle(RunControl& control) {
    if (self_->unsettled.empty()) return;
    const TimeAccount::Scope spent(self_->account, Spent::compiling);
    self_->stepper->settle();
    self_->warn_of_refused(control);
}

Compile Simulation::Implementation::often() const {
    if (is_small()) return interpreted(grid);
    return [this, interpret = interpreted(grid)](const CellKernel& kernel) {
        const TimeAccount::Scope spent(account, Spent::compiling);
        if (runs_meanwhile()) {
            return stepper->begin(kernel, grid.stencil(), TieredBackend::When::when_used);
        }
        auto made = stepper->compile(kernel, grid.stencil());
        return made ? *made : interpret(kernel);
    };
}

bool Simulation::Implementation::is_long(std::uint32_t k) const {
    const Stage& taken = stage(k);
    const bool is_counted = !taken.time.open_end && !taken.time.has_duration() &&
                            !taken.time.steady && !taken.time.until;
    return is_counted &&
           taken.iterations > cells_worth_compiling / std::max<std::int64_t>(1, grid.cell_count());
}

void Simulation::Implementation::expect_later_stages(std::uint32_t k) {
    if (!starts_interpreted || std::exchange(has_expected, true)) return;
    const TimeAccount::Scope spent(account, Spent::compiling);
    for (std::uint32_t later = k + 1; later < script->stage_count(); ++later) {
        if (!is_long(later)) continue;
        const Solver solver = stage(later).time.solver;
        const auto species = program->system_of(later).species_count();
        const Scheme scheme = make_scheme(solver, species, steps_by_item(stage(later)));
        for (const SweepForm& form : scheme.forms) {
            for (const Pass& pass : plans->sweep(later, form).passes) {
                stepper->expect(pass.bound.kernel, grid.stencil());
            }
        }
    }
}

}  // namespace cascade
