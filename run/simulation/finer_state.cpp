// Planes are carried; numbers along a side are repeated.
#include "run/simulation/finer_state.h"

#include "run/domain/field_values.h"
#include "run/simulation/regridded_state.h"

#include <memory>

namespace cascade {

namespace {

/// The values of a side, each for the parts of its cell. Cells beside a side are numbered along its
/// first axis, then along its second.
std::shared_ptr<const SideValues> repeated(const SideValues& values, const Grid& grid,
                                           std::size_t axis, std::int64_t times) {
    const std::int64_t width = axis == 0 ? grid.height : grid.width;
    const std::int64_t height = axis == 2 ? grid.height : grid.depth;
    const std::int64_t across = width > 1 ? times : 1, down = height > 1 ? times : 1;
    SideValues result;
    for (std::int64_t j = 0; j < height * down; ++j) {
        for (std::int64_t i = 0; i < width * across; ++i) {
            result.numbers.push_back(values.at(j / down * width + i / across));
        }
    }
    return std::make_shared<const SideValues>(std::move(result));
}

}  // namespace

StageState finer_state(const StageState& state, const CellCarrier& carrier, const Grid& grid,
                       const Grid& finer, std::int64_t times) {
    StageState result =
        regridded(state, {finer.spacing, [&](const Field& plane) { return carrier.carried(plane); },
                          [&](const SideValues& values, std::size_t side) {
                              return repeated(values, grid, side / 2, times);
                          }});
    if (!state.frozen.empty()) {
        result.frozen = carrier.repeated(state.frozen);
        Field& flags = result.fields[frozen_item(result)];
        flags = to_field(result.frozen, flags.precision());
    }
    return result;
}

}  // namespace cascade
