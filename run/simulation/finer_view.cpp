// All planes are divided; what is uniform stays.
#include "run/simulation/finer_view.h"

#include "core/resample.h"
#include "lang/program/nodes_of_rates.h"
#include "run/simulation/finer_state.h"
#include "run/simulation/stage_view.h"

#include <memory>

namespace cascade {

namespace {

/// Integrals over the domain are such sums, too.
bool sums_over_domain(const System& system, const Formula& formula) {
    const auto is_sum = [](const Node& node) { return node.calls(Function::domain_sum); };
    const auto refers_to_others = [](const Node& node) {
        return node.is<DefinitionId>() || node.is<Rate>();
    };
    return holds_in(formula, is_sum) ||
           (holds_in(formula, refers_to_others) && find_in_rates(system, is_sum) != nullptr);
}

}  // namespace

FinerView::FinerView(const Environment& environment, std::span<const StageState> states,
                     std::int64_t times)
    : run_(environment), run_states_(states) {
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
    carrier_ = carrier_on_grid(grid, times, nullptr, nullptr, Crests::kept);
    here.files =
        environment.files.mapped([&](const Field& plane) { return carrier_->carried(plane); });
    for (const StageState& state : states)
        states_.push_back(finer_state(state, *carrier_, grid, here.grid, times));
}

std::vector<Field> FinerView::evaluate(const Formula& formula, std::uint32_t stage) const {
    if (!sums_over_domain(run_.program->system_of(stage), formula)) {
        return StageView(environment_, states_, stage).evaluate(formula);
    }
    std::vector<Field> values = StageView(run_, run_states_, stage).evaluate(formula);
    for (Field& field : values) field = carrier_->carried(field);
    return values;
}

}  // namespace cascade
