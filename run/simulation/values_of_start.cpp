// The plan of the start is run in the cells of the present state.
#include "run/simulation/values_of_start.h"

#include "run/simulation/tissue_stage.h"
#include "tissue/tissue.h"

#include <algorithm>
#include <variant>

namespace cascade {

namespace {

/// Does a plan read the cells of an earlier stage?
bool reads_earlier_cells(const StepPlan& plan, std::uint32_t stage) {
    const auto is_earlier = [stage](const PlaneSource& source) {
        const auto* const item = std::get_if<StageItem>(&source);
        return item != nullptr && item->stage != stage;
    };
    return std::ranges::any_of(plan.passes, [&](const Pass& pass) {
        return std::ranges::any_of(pass.bound.fields, is_earlier);
    });
}

}  // namespace

std::vector<std::vector<double>> values_of_start(const Environment& environment,
                                                 std::span<const StageState> states,
                                                 std::uint32_t k) {
    const Tissue& tissue = *states[k].tissue;
    const StepPlan& plan = environment.plans->start(k);
    if (tissue.count() == 0 || reads_earlier_cells(plan, k)) return {};
    const TissueStage stage = tissue_stage(environment, states, k);
    const auto values = evaluate_in(tissue, plan, stage, neighbours_of(stage, 0),
                                    environment.tissue_kernels->once(), *environment.team);
    if (!values) return {};
    std::vector<std::vector<double>> by_item(environment.program->system_of(k).item_count());
    for (std::size_t r = 0; r < values->size(); ++r) {
        const ItemId item = plan.results[r];
        if (environment.stage(k).uniform[item]) continue;
        for (const std::uint32_t cell : tissue.by_number()) {
            by_item[item.index()].push_back(value_in((*values)[r], tissue, cell));
        }
    }
    return by_item;
}

}  // namespace cascade
