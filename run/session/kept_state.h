// The values of a run at one moment, separate from its simulation, and their use in another
// simulation.
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

/// The names of a stage's items with painted values.
using PaintedNames = std::set<std::string>;

/// A stage that has started.
struct KeptStage {
    std::string name;
    StageRecord record;    ///< Includes the painted parameters.
    PaintedNames painted;  ///< Species and parameters.
    /// The names of all items and of the species, for crawling cells.
    std::vector<std::string> items, species;
};

struct KeptState {
    std::vector<KeptStage> stages;  ///< The last one is the stage that takes steps.

    std::size_t bytes() const;
};

/// Copies all values that a simulation cannot recompute. `painted` has an entry for each stage.
KeptState keep(const Simulation& simulation, const std::vector<PaintedNames>& painted);

/// How a simulation continues from a kept state.
enum class Continuation {
    same,     ///< With the same program, and the same bits as without interruption.
    changed,  ///< With a changed program: lengths of steps are chosen anew.
};

/// Starts those stages of `simulation`, none of them started, that have a counterpart in `state`:
/// the stage of the same name, or at the same index if it was renamed. Computes parameters anew
/// except where they were painted. Species take the values of the same name, or else their start.
/// The current stage is restarted if it has taken no step, except for painted values. Starts at
/// most `count` stages. Returns the painted names for each started stage. Crawling cells continue
/// with their own values of parameters, too, unless their start would give others than in `before`,
/// the source of the kept state (null: none). Fails if a stage cannot be started, if cells have no
/// value to continue with, and when `cancel` becomes true while a stage is started.
Result<std::vector<PaintedNames>> go_on(Simulation& simulation, const Simulation* before,
                                        const KeptState& state, Continuation how,
                                        const std::atomic<bool>& cancel,
                                        std::size_t count = SIZE_MAX);

/// The item of a system with this name.
std::optional<ItemId> find_item(const System& system, std::string_view name);

/// Whether a run of `after` can continue from the values of a run of `before`. Their cells must be
/// the same: the grid, the mask, the model, and the precision and seed of the run.
bool have_same_cells(const Program& before, const Program& after);

}  // namespace cascade
