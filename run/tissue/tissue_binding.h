// What plans of a stage of cells that crawl read of these cells, and values of such plans.
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

/// A stage of cells that crawl, and all that it shares with others.
struct TissueStage {
    const Program& program;
    std::uint32_t stage = 0;
    const TissueGround& ground;
    BindingContext fields;  ///< Of the stage, without its tissue: what its cells sense.

    const System& system() const { return program.system_of(stage); }
    const CellRules& rules() const { return *system().cells; }
    SpeciesId species_of(ItemId item, std::size_t component = 0) const {
        return *system().species_of(ItemId(item.index() + component));
    }
};

/// The binding of plans to a tissue. Links are left out. Values that cells sense are those of the
/// moment.
TissueBinding binding_of(const TissueStage& stage, const Tissue& tissue,
                         std::span<const StepPlan* const> plans,
                         std::shared_ptr<NearTriangles> near);

/// Does a plan read other cells by links?
bool reads_links(const StepPlan& plan);

/// Which cells are neighbours, given the distance of the widest `over near(d)`.
NeighbourRule neighbours_of(const TissueStage& stage, double near);

/// The values of a plan in the cells of a tissue at its present state, in the order of memory.
/// Fails if there are too many neighbours.
Result<std::vector<Field>> evaluate_in(const Tissue& tissue, const StepPlan& plan,
                                       const TissueStage& stage, const NeighbourRule& rule,
                                       const Compile& compile, Team& team);

}  // namespace cascade
