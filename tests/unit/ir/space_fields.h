// Fields of functions of position (shapes, noise and lattices) on a grid, run by the interpreter.
#pragma once

#include "core/floating_point.h"
#include "core/plane.h"
#include "ir/interpreter.h"
#include "ir/space.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace cascade::test {

/// A key of random numbers.
inline constexpr std::uint64_t some_key = 0x0123456789abcdefULL;

/// The coordinates of a cell, as scripts read them: its centre divided by the longest side.
inline Space space_of(KernelBuilder& builder, const Grid& grid) {
    const auto longest = static_cast<float>(grid.longest_side());
    const auto axis = [&](std::int64_t side, ValueId cell, Boundary boundary) {
        const ValueId number = builder.apply(Op::bits_to_number, cell);
        const ValueId middle = builder.add(number, builder.number(0.5f));
        return SpaceAxis{builder.divide(middle, builder.number(longest)),
                         static_cast<float>(side) / longest, boundary == Boundary::periodic,
                         side > 1};
    };
    return {axis(grid.width, builder.cell_column(), grid.boundary.x),
            axis(grid.height, builder.cell_row(), grid.boundary.y),
            axis(grid.depth, builder.cell_slice(), grid.boundary.z)};
}

/// `expand(builder, space)` gives the value of a cell.
template <typename Expand>
Field field_of(const Grid& grid, const Expand& expand) {
    KernelBuilder builder;
    const Space space = space_of(builder, grid);
    builder.result("r", expand(builder, space));
    const CellKernel kernel = std::move(builder).finish();
    Field out{PlaneLayout(grid)};
    float* results[] = {out.origin()};
    const FlushDenormals environment;
    const KernelPointer compiled = *make_interpreter()->compile(kernel, grid.stencil());
    compiled->run({{}, {}, {}, results, out.layout()}, {0, out.layout().row_count()});
    return out;
}

/// The values of a field, slice by slice and row by row.
inline std::vector<double> cells_of(const Field& field) {
    std::vector<double> cells;
    const PlaneLayout& layout = field.layout();
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        const float* first = field.origin() + layout.row_start(row);
        cells.insert(cells.end(), first, first + layout.width);
    }
    return cells;
}

struct Moments {
    double mean = 0;
    double variance = 0;
    double least = 0;
    double most = 0;
};

inline Moments moments_of(const std::vector<double>& cells) {
    Moments moments{0, 0, cells[0], cells[0]};
    for (const double value : cells) {
        moments.mean += value / static_cast<double>(cells.size());
        moments.least = std::min(moments.least, value);
        moments.most = std::max(moments.most, value);
    }
    for (const double value : cells) {
        moments.variance +=
            (value - moments.mean) * (value - moments.mean) / static_cast<double>(cells.size());
    }
    return moments;
}

}  // namespace cascade::test
