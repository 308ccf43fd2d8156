// The plane: a grid of cells and how a field of it lies in memory.
#pragma once

#include <cstdint>

namespace cascade {

/// What a cell at the side of the grid sees beyond it.
enum class Boundary {
    periodic,  ///< The cell of the opposite side.
    no_flux,   ///< Itself: nothing flows through the side.
};

/// Which neighbours a Laplacian reads. An axis of one cell has no neighbours along it, so a grid
/// of W × 1 or 1 × H cells is one-dimensional.
enum class Stencil {
    row,     ///< W, E: (E + W) − 2c.
    column,  ///< N, S: (N + S) − 2c.
    plane,   ///< ((N + S) + E) + W − 4c.
};

/// A grid of width × height square cells. N is the row above (j − 1), E the next column (i + 1).
struct Grid {
    std::int64_t width = 64;
    std::int64_t height = 64;
    Boundary boundary = Boundary::periodic;

    std::int64_t cell_count() const { return width * height; }
    std::int64_t longest_side() const { return width > height ? width : height; }
    Stencil stencil() const {
        if (height == 1) return Stencil::row;
        return width == 1 ? Stencil::column : Stencil::plane;
    }
    friend bool operator==(const Grid&, const Grid&) = default;
};

/// How a plane of elements lies in memory: `height` rows with one halo row above and below; each
/// row starts on a multiple of `row_pad` elements and has `row_pad` elements before and at least
/// `row_pad` behind it, so that a vector may be read or written at the end of a row without
/// touching another row's cells. Columns −1 and `width`, rows −1 and `height` are the halo.
struct PlaneLayout {
    static constexpr std::int64_t row_pad = 16;

    std::int64_t width = 0;
    std::int64_t height = 0;
    std::int64_t stride = 0;  ///< Elements from a row to the next; a multiple of `row_pad`.

    PlaneLayout() = default;
    explicit PlaneLayout(const Grid& grid)
        : width(grid.width),
          height(grid.height),
          stride((grid.width + row_pad - 1) / row_pad * row_pad + 2 * row_pad) {}

    /// Element number of cell (column i, row j), counted from the start of the allocation.
    std::int64_t offset(std::int64_t i, std::int64_t j) const {
        return (j + 1) * stride + row_pad + i;
    }
    /// Elements to allocate.
    std::int64_t size() const { return (height + 2) * stride; }

    friend bool operator==(const PlaneLayout&, const PlaneLayout&) = default;
};

}  // namespace cascade
