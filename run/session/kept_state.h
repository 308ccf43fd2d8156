// The values of a run at one moment, apart from its simulation, and a simulation that goes on from
// them.
#pragma once

#include "core/result.h"
#include "run/simulation/simulation.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The names of items of a stage whose values were painted.
using PaintedNames = std::set<std::string>;

/// A stage that has started.
struct KeptStage {
    std::string name;
    StageRecord record;    ///< With those parameters that were painted.
    PaintedNames painted;  ///< Species and parameters.
    /// The names of all items and of the species, for cells that crawl.
    std::vector<std::string> items, species;
};

struct KeptState {
    std::vector<KeptStage> stages;  ///< The last one is that in which steps are taken.

    std::size_t bytes() const;
};

/// Copies all values that a simulation cannot compute anew. `painted` has an entry for each stage.
KeptState keep(const Simulation& simulation, const std::vector<PaintedNames>& painted);

/// How a simulation goes on from a kept state.
enum class Continuation {
    same,     ///< Of the same program, with the same bits as if nothing had happened.
    changed,  ///< Of a changed program: lengths of steps are chosen anew.
};

/// Starts the stages of `simulation`, of which none has started, that have a counterpart in
/// `state`: that of the same name, or at the same place where it was given another name. Parameters
/// are computed anew but where they were painted; species take the values of those of the same
/// name, the others those of their start. The current stage is started anew where it has taken no
/// step, but for what was painted. At most `count` stages are started. Returns what is painted, for
/// each stage that was started. Cells that crawl go on with their own values of parameters, too,
/// unless their start would give them others than in `before`, whose state was kept (null: none
/// was). Fails if a stage cannot be started, if cells have no value to go on with, and when
/// `cancel` becomes true while a stage is started.
Result<std::vector<PaintedNames>> go_on(Simulation& simulation, const Simulation* before,
                                        const KeptState& state, Continuation how,
                                        const std::atomic<bool>& cancel,
                                        std::size_t count = SIZE_MAX);

/// The item of a system with this name.
std::optional<ItemId> find_item(const System& system, std::string_view name);

/// Can a run of `after` go on from the values of a run of `before`? Their cells must be the same:
/// the grid, the mask, the model, and the precision and seed of the run.
bool have_same_cells(const Program& before, const Program& after);

}  // namespace cascade
