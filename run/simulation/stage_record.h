// What starting a stage again would not give: all that a run needs to go on from a moment of it.
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

struct TissueRecord;

/// A moment of a stage from which its run can go on, in its own cells. With another `time` and
/// `watch` than that of the moment, steps are chosen as at the start of a stage.
struct StageRecord : StageMoment {
    /// By the names of items: all species, and those parameters that have other values than a start
    /// gives them. Empty for cells that crawl.
    std::map<std::string, Field, std::less<>> fields;
    std::shared_ptr<const TissueRecord> cells;  ///< Cells that crawl; null for fields.

    std::size_t bytes() const;  ///< Of all its values.
};

/// The present moment of a stage that has started, with those parameters that are named.
StageRecord record_of(const StageState& state, const Program& program, std::uint32_t stage,
                      const std::set<std::string>& parameters = {});

/// The items whose values a record may hold: species, and parameters that vary.
std::vector<ItemId> recorded_items(const Program& program, std::uint32_t stage);

}  // namespace cascade
