// The state of a stage with its own cells is transferred to the cells of the domain only when it is
// read there.
#include "run/simulation/stages_on_grids.h"

#include "run/simulation/finer_run.h"
#include "run/stage/memory.h"

#include <utility>

namespace cascade {

StagesOnGrids::StagesOnGrids(std::unique_ptr<Environment> domain, std::uint32_t stages_that_run)
    : domain_(std::move(domain)), states_(domain_->program->stages.size()) {
    for (std::uint32_t k = 0; k < stages_that_run; ++k) {
        const std::int64_t times = domain_->stage(k).coarse;
        if (times == 1) continue;
        Program program = coarser_program(domain_->script, *domain_->program, times);
        StagesInOtherCells made{on_coarser_grid(*domain_, std::move(program), &domain_->account),
                                std::vector<StageState>(states_.size())};
        domain_->memory += memory_of(*made.environment->program, made.environment->plans);
        coarser_.emplace(k, std::move(made));
    }
}

std::span<StageState> StagesOnGrids::in_domain() {
    for (const std::uint32_t k : std::exchange(ahead_, {}))
        states_[k] = on_grid(state(k), environment(k).grid, domain_->grid);
    return states_;
}

Environment& StagesOnGrids::environment(std::uint32_t stage) {
    const auto own = coarser_.find(stage);
    return own == coarser_.end() ? *domain_ : *own->second.environment;
}

std::span<StageState> StagesOnGrids::states(std::uint32_t stage) {
    const auto own = coarser_.find(stage);
    return own == coarser_.end() ? states_ : own->second.states;
}

void StagesOnGrids::touch(std::uint32_t stage) {
    if (has_own_cells(stage)) ahead_.insert(stage);
}

void StagesOnGrids::look_back(std::uint32_t stage) {
    if (!has_own_cells(stage)) {
        in_domain();
        return;
    }
    for (std::uint32_t before = 0; before < stage; ++before) {
        states(stage)[before] =
            on_grid(state(before), environment(before).grid, environment(stage).grid);
    }
}

void StagesOnGrids::take_divided(StagesOnGrids& run) {
    const auto of_domain = carrier_to_finer(*run.domain_, *domain_);
    for (std::uint32_t k = 0; k < states_.size(); ++k) {
        if (!run.state(k).started) continue;
        const Environment &from = run.environment(k), &to = environment(k);
        const auto own = has_own_cells(k) ? carrier_to_finer(from, to) : nullptr;
        state(k) = carried_state(run.state(k), own ? *own : *of_domain, to.grid.spacing);
        touch(k);
    }
}

}  // namespace cascade
