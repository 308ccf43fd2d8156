// The dimensionless groups of a stage. A group is a product of powers of the stage's values, and
// has no unit.
#pragma once

#include "lang/check/check_dimensions.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

/// A value, raised to an integer power.
struct GroupFactor {
    std::string name;
    std::int64_t power = 1;
};
using DimensionlessGroup = std::vector<GroupFactor>;

/// The groups of a stage. If there are none because some values have no unit, these values.
struct DimensionlessGroups {
    std::vector<DimensionlessGroup> groups;
    std::vector<std::string> without_unit;
};

/// A complete set of independent groups of a stage, by Buckingham's theorem. The groups consist of
/// the parameters and, if these have a unit, of the domain's first length (called `width`) and the
/// duration (called `duration`). Every group is a null vector of the matrix of dimensions, found by
/// exact elimination. The values that are declared first occur in the most groups.
DimensionlessGroups dimensionless_groups(const ProgramUnits& units, const Program& program,
                                         std::uint32_t stage);

}  // namespace cascade
