// Records everything that a run needs to continue a stage from a moment.
#pragma once

#include "core/plane.h"
#include "lang/program/program.h"
#include "run/stage/stage_state.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace cascade {

class Simulation;
struct TissueRecord;

/// The values of items, by the names of the items: all species, and the parameters that the start
/// of the stage cannot compute again.
using RecordedFields = std::map<std::string, Field, std::less<>>;
using RecordedCells = std::shared_ptr<const TissueRecord>;  ///< Never null.

/// A moment of a stage from which its run can continue, in the stage's own cells. If `time` and
/// `watch` are empty, the lengths of steps are chosen as at the start of a stage.
struct StageRecord : StageMoment {
    /// The fields or the crawling cells.
    std::variant<RecordedFields, RecordedCells> values;

    bool is_of_cells() const { return std::holds_alternative<RecordedCells>(values); }
    std::size_t bytes() const;  ///< The size of all values, in bytes.
};

/// Records the present moment of a started stage, with the named parameters.
StageRecord record_of(const StageState& state, const Program& program, std::uint32_t stage,
                      const std::set<std::string>& parameters = {});

/// Lets a started stage continue from another moment. The record must contain all species of a
/// stage of fields, or all values of crawling cells. Crawling cells record their own time and
/// lengths of steps. So for them, `t` and `time` of the record are not used.
void restore(Simulation& simulation, std::uint32_t stage, StageRecord record);

/// Returns the items that a record may contain: species, and parameters that vary.
std::vector<ItemId> recorded_items(const Program& program, std::uint32_t stage);

}  // namespace cascade
