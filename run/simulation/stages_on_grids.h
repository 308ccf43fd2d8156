// The states of all stages of a simulation: each in its own cells, which may be wider than those of
// the domain, and in those of the domain, as pictures and other stages see them.
#pragma once

#include "run/simulation/other_cells.h"
#include "run/simulation/environment.h"
#include "run/simulation/stage_view.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

namespace cascade {

class StagesOnGrids {
public:
    /// Makes the coarser grids of the stages that run; their planes count as memory of `domain`.
    StagesOnGrids(std::unique_ptr<Environment> domain, std::uint32_t stages_that_run);

    Environment& domain() { return *domain_; }
    /// All stages in the cells of the domain, as they are now. Pointers into it hold until the next
    /// change of a state.
    std::span<StageState> in_domain();
    StageView view(std::uint32_t stage) { return {*domain_, in_domain(), stage}; }

    // A stage in its own cells.
    Environment& environment(std::uint32_t stage);
    std::span<StageState> states(std::uint32_t stage);
    StageState& state(std::uint32_t stage) { return states(stage)[stage]; }
    StageView own_view(std::uint32_t stage) { return {environment(stage), states(stage), stage}; }
    bool has_own_cells(std::uint32_t stage) const { return coarser_.contains(stage); }

    /// Must be called when the state of a stage has changed, or is about to.
    void touch(std::uint32_t stage);
    /// Gives a stage the present states of those before it, in its own cells.
    void look_back(std::uint32_t stage);
    /// Takes all stages of a run of the same script in divided cells from that of its own cells.
    void take_divided(StagesOnGrids& run);

private:
    std::unique_ptr<Environment> domain_;
    std::vector<StageState> states_;
    std::map<std::uint32_t, StagesInOtherCells> coarser_;
    std::set<std::uint32_t> ahead_;  ///< Of which `states_` has an older state.
};

}  // namespace cascade
