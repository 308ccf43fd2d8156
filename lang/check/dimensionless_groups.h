// The dimensionless groups of a stage: products of powers of its values that have no unit.
#pragma once

#include "lang/check/check_dimensions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

/// A value to a whole power.
struct GroupFactor {
    std::string name;
    std::int64_t power = 1;
};
using DimensionlessGroup = std::vector<GroupFactor>;

/// The groups of a stage, or the values without a unit because of which there are none.
struct DimensionlessGroups {
    std::vector<DimensionlessGroup> groups;
    std::vector<std::string> without_unit;
};

/// A complete set of independent groups of a stage, by Buckingham's theorem. Groups consist of the
/// parameters and, if they have a unit, of the domain's first length (called `width`) and of the
/// duration (called `duration`). Every group is a null vector of the matrix of dimensions, found by
/// exact elimination. Values that are declared first occur in most groups.
DimensionlessGroups dimensionless_groups(const ProgramUnits& units, const Program& program,
                                         std::uint32_t stage);

}  // namespace cascade
