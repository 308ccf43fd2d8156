// All planes are divided; what is uniform stays.
#include "run/simulation/finer_view.h"

#include "core/resample.h"
#include "run/simulation/finer_state.h"
#include "run/simulation/stage_view.h"

#include <memory>

namespace cascade {

FinerView::FinerView(const Environment& environment, std::span<const StageState> states,
                     std::int64_t times) {
    Environment& here = environment_;
    const Grid& grid = environment.grid;
    here.script = environment.script;
    here.own_program = *environment.program;
    here.own_program->domain.grid = finer_grid(grid, times);
    here.program = &*here.own_program;
    here.grid = here.program->domain.grid;
    here.threads = environment.threads;
    here.plans = std::make_unique<StagePlans>(*here.program, environment.plans->options());
    here.kernels =
        std::make_unique<KernelMaker>(here.grid, environment.kernels->stepper(),
                                      environment.kernels->starts_interpreted(), nullptr);
    here.team = std::make_unique<Team>(environment.team->size());
    const auto carrier = carrier_on_grid(grid, times, nullptr, nullptr);
    here.files =
        environment.files.mapped([&](const Field& plane) { return carrier->carried(plane); });
    for (const StageState& state : states)
        states_.push_back(finer_state(state, *carrier, grid, here.grid, times));
}

std::vector<Field> FinerView::evaluate(const Formula& formula, std::uint32_t stage) const {
    return StageView(environment_, states_, stage).evaluate(formula);
}

}  // namespace cascade
