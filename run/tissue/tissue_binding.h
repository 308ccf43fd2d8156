// Connects the plans of a stage of crawling cells to the data that they read, and evaluates such
// plans.
#pragma once

#include "core/result.h"
#include "run/stage/bound_kernel.h"
#include "run/tissue/ground.h"
#include "tissue/neighbours.h"
#include "tissue/tissue.h"

#include <memory>
#include <span>
#include <vector>

namespace cascade {

/// A stage of crawling cells, and everything that it shares with other stages.
struct TissueStage {
    const Program& program;
    std::uint32_t stage = 0;
    const TissueGround& ground;
    /// The context of the stage without its tissue. Through it, crawling cells read planes of the
    /// domain.
    BindingContext fields;

    const System& system() const { return program.system_of(stage); }
    const CellRules& rules() const { return *system().cells; }
    SpeciesId species_of(ItemId item, std::size_t component = 0) const {
        return *system().species_of(ItemId(item.index() + component));
    }
};

/// Binds plans to a tissue, without links. Afterwards, the values of the domain's planes at the
/// crawling cells are current.
TissueBinding binding_of(const TissueStage& stage, const Tissue& tissue,
                         std::span<const StepPlan* const> plans,
                         std::shared_ptr<NearTriangles> near);

/// Whether a plan reads other cells through links.
bool reads_links(const StepPlan& plan);

/// Returns the rule that decides which cells are neighbours. `near` is the largest distance d in
/// any `over near(d)`.
NeighbourRule neighbours_of(const TissueStage& stage, double near);

/// Evaluates a plan in the cells of a tissue, which has its present state. The values are in the
/// order in which memory stores the cells. Fails if the cells have too many neighbours in total.
Result<std::vector<Field>> evaluate_in(const Tissue& tissue, const StepPlan& plan,
                                       const TissueStage& stage, const NeighbourRule& rule,
                                       const Compile& compile, Team& team);

}  // namespace cascade
