// Divides all planes into smaller cells. Uniform values need no change.
#include "run/simulation/finer_view.h"

#include "core/resample.h"
#include "lang/program/nodes_of_rates.h"
#include "run/simulation/stage_view.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace cascade {

namespace {

/// Whether a formula contains a sum or an integral over the domain.
bool sums_over_domain(const System& system, const Formula& formula) {
    const auto is_sum = [](const Node& node) { return node.calls(Function::domain_sum); };
    const auto refers_to_others = [](const Node& node) {
        return node.is<DefinitionId>() || node.is<Rate>();
    };
    return holds_in(formula, is_sum) ||
           (holds_in(formula, refers_to_others) && find_in_rates(system, is_sum) != nullptr);
}

}  // namespace

FinerView::FinerView(const StageView& view, std::int64_t times)
    : run_(view.environment()), run_states_(view.states()) {
    carrier_ = carrier_to_finer(run_.grid, times, nullptr, nullptr, Crests::kept);
    Program program = *run_.program;
    program.domain.grid = finer_grid(run_.grid, times);
    finer_.environment = environment_in_cells(run_, std::move(program), *carrier_, nullptr);
    for (const StageState& state : run_states_)
        finer_.states.push_back(carried_state(state, *carrier_, finer_.environment->grid.spacing));
}

std::vector<Field> FinerView::evaluate(const Formula& formula, std::uint32_t stage) const {
    if (!sums_over_domain(run_.program->system_of(stage), formula)) {
        return StageView(*finer_.environment, finer_.states, stage).evaluate(formula);
    }
    std::vector<Field> values = StageView(run_, run_states_, stage).evaluate(formula);
    for (Field& field : values) field = carrier_->carried(field);
    return values;
}

std::unique_ptr<const FinerView> finer_view(const Simulation& simulation, std::int64_t times) {
    const SimulationDomain& domain = simulation.domain();
    const bool is_plane =
        !domain.mask && !domain.model && !domain.program->domain.surface && domain.grid.depth == 1;
    const StageView view = simulation.view(0);
    const auto is_of_cells = [](const StageState& state) { return state.tissue() != nullptr; };
    if (!is_plane || std::ranges::any_of(view.states(), is_of_cells)) return nullptr;
    return std::make_unique<const FinerView>(view, times);
}

}  // namespace cascade
