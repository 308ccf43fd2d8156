// Holds the states of all stages in the cells of the domain. Pictures and other stages read these
// states. If a stage has its own, wider cells, also holds the state of the stage in its own cells.
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
    /// Makes the coarser grids of the first `stages_that_run` stages. Their planes are added to the
    /// memory of `domain`.
    StagesOnGrids(std::unique_ptr<Environment> domain, std::uint32_t stages_that_run);

    Environment& domain() { return *domain_; }
    /// Returns the present states of all stages in the cells of the domain. Pointers into the
    /// result are valid until a state changes.
    std::span<StageState> in_domain();
    StageView view(std::uint32_t stage) { return {*domain_, in_domain(), stage}; }

    // The following functions return the environment and the state of a stage in its own cells.
    Environment& environment(std::uint32_t stage);
    std::span<StageState> states(std::uint32_t stage);
    StageState& state(std::uint32_t stage) { return states(stage)[stage]; }
    StageView own_view(std::uint32_t stage) { return {environment(stage), states(stage), stage}; }
    bool has_own_cells(std::uint32_t stage) const { return coarser_.contains(stage); }

    /// Must be called immediately before or after each change of a stage's state.
    void touch(std::uint32_t stage);
    /// Transfers the present states of the stages before this stage to this stage's own cells.
    void look_back(std::uint32_t stage);
    /// Takes the states of all stages from a run of the same script in undivided cells.
    void take_divided(StagesOnGrids& run);

private:
    std::unique_ptr<Environment> domain_;
    std::vector<StageState> states_;
    std::map<std::uint32_t, StagesInOtherCells> coarser_;
    std::set<std::uint32_t> ahead_;  ///< The stages whose state in `states_` is outdated.
};

}  // namespace cascade
