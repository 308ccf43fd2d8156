// Everything that a run needs to continue a stage from one moment.
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
#include <vector>

namespace cascade {

class Simulation;
struct TissueRecord;

/// A moment of a stage from which its run can continue, in the stage's own cells. If `time` and
/// `watch` are empty, the lengths of steps are chosen as at the start of a stage.
struct StageRecord : StageMoment {
    /// By the names of items: all species, and parameters whose values the start does not give.
    /// Empty for crawling cells.
    std::map<std::string, Field, std::less<>> fields;
    std::shared_ptr<const TissueRecord> cells;  ///< Crawling cells. Null for fields.

    std::size_t bytes() const;  ///< The size of all values.
};

/// The present moment of a stage that has started, with the named parameters.
StageRecord record_of(const StageState& state, const Program& program, std::uint32_t stage,
                      const std::set<std::string>& parameters = {});

/// Makes a started stage go on from another moment. The record has all species of a stage of
/// fields, or all values of cells that crawl; of their moment only steps and ends count.
void restore(Simulation& simulation, std::uint32_t stage, StageRecord record);

/// The items that a record may hold: species, and parameters that vary by cell.
std::vector<ItemId> recorded_items(const Program& program, std::uint32_t stage);

}  // namespace cascade
