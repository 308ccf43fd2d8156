// Data of crawling cells for the plans of their stage, and values of such plans.
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

/// A stage of crawling cells, and everything it shares with others.
struct TissueStage {
    const Program& program;
    std::uint32_t stage = 0;
    const TissueGround& ground;
    BindingContext fields;  ///< The stage without its tissue, for the cells' senses.

    const System& system() const { return program.system_of(stage); }
    const CellRules& rules() const { return *system().cells; }
    SpeciesId species_of(ItemId item, std::size_t component = 0) const {
        return *system().species_of(ItemId(item.index() + component));
    }
};

/// The binding of plans to a tissue, without links. Values that cells sense are current.
TissueBinding binding_of(const TissueStage& stage, const Tissue& tissue,
                         std::span<const StepPlan* const> plans,
                         std::shared_ptr<NearTriangles> near);

/// Whether a plan reads other cells by links.
bool reads_links(const StepPlan& plan);

/// The rule of neighbours, given the distance of the widest `over near(d)`.
NeighbourRule neighbours_of(const TissueStage& stage, double near);

/// The values of a plan in the cells of a tissue at its present state, in the order of memory.
/// Fails if there are too many neighbours.
Result<std::vector<Field>> evaluate_in(const Tissue& tissue, const StepPlan& plan,
                                       const TissueStage& stage, const NeighbourRule& rule,
                                       const Compile& compile, Team& team);

}  // namespace cascade
