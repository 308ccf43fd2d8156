// The values of a run at one moment, stored independently of its simulation, so that another
// simulation can continue from them.
#pragma once

#include "core/result.h"
#include "run/simulation/simulation.h"
#include "run/simulation/stage_record.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The names of the items of a stage that have been painted.
using PaintedNames = std::set<std::string>;

/// The stored values of a stage that has started.
struct KeptStage {
    std::string name;
    StageRecord record;    ///< Includes the painted parameters.
    PaintedNames painted;  ///< May contain the names of species and parameters.
    /// For crawling cells: the names of all items, and the names of the species.
    std::vector<std::string> items, species;
};

struct KeptState {
    std::vector<KeptStage> stages;  ///< The last element is the stage that takes steps.

    std::size_t bytes() const;
};

/// Copies all values that a simulation could not compute again. `painted` has an entry for each
/// stage.
KeptState keep(const Simulation& simulation, const std::vector<PaintedNames>& painted);

/// The way in which a simulation continues from a stored state.
enum class Continuation {
    same,  ///< With the same program. The further steps give the same bits as without interruption.
    changed,  ///< With a changed program. The lengths of steps are chosen anew.
};

/// Starts the stages of `simulation` that have a counterpart in `state`, and gives each the values
/// of its counterpart. No stage may have been started before. The counterpart is the stage with the
/// same name or, if the stage was renamed, the stage at the same index. Parameters are computed
/// anew unless they were painted. A species takes the values of the species with the same name or,
/// if there is none, its starting values. If the current stage has taken no step, it is restarted,
/// and only painted values are taken over. At most `count` stages are started.
///
/// `before` is the simulation from which `state` comes, or null. Crawling cells also keep the
/// values of a parameter, unless the start of the stage now gives it other values than in `before`.
///
/// Returns the painted names of each started stage. Fails if a stage cannot be started, if cells
/// lack a value, or if `cancel` becomes true while a stage is started.
Result<std::vector<PaintedNames>> go_on(Simulation& simulation, const Simulation* before,
                                        const KeptState& state, Continuation how,
                                        const std::atomic<bool>& cancel,
                                        std::size_t count = SIZE_MAX);

/// Returns the item with this name, or an empty optional if the system has no such item.
std::optional<ItemId> find_item(const System& system, std::string_view name);

/// Whether a run of `after` can continue from the values of a run of `before`. Both must have the
/// same cells, that is, the same grid, mask, model, precision and seed.
bool have_same_cells(const Program& before, const Program& after);

}  // namespace cascade
