// The grid of cells and the memory layout of a field on it.
#pragma once

#include "core/rows.h"

#include <algorithm>
#include <cstdint>

namespace cascade {

/// The neighbour that a cell at a side of the grid has beyond this side. A species may have its own
/// rule.
enum class Boundary {
    periodic,  ///< The cell at the opposite side.
    no_flux,   ///< The cell itself: nothing flows through the side.
};

/// The boundary along each axis. Converts implicitly from one boundary for all axes.
struct Boundaries {
    Boundary x = Boundary::periodic;
    Boundary y = Boundary::periodic;
    Boundary z = Boundary::periodic;

    constexpr Boundaries() = default;
    constexpr Boundaries(Boundary all)
        : x(all), y(all), z(all) {}  // NOLINT: scripts give one word for all axes.
    constexpr Boundaries(Boundary along_x, Boundary along_y, Boundary along_z)
        : x(along_x), y(along_y), z(along_z) {}

    friend bool operator==(const Boundaries&, const Boundaries&) = default;
};

/// The set of neighbours of a cell. Along an axis of one cell there are no neighbours, so a grid of
/// W × 1 or 1 × H cells is one-dimensional. A Laplacian is summed as ((((N + S) + E) + W) + U) + D
/// − 2·axes·c, without the missing pairs.
struct Stencil {
    bool x = true;   ///< W and E, the columns before and after.
    bool y = true;   ///< N and S, the rows above and below.
    bool z = false;  ///< U and D, the slices before and after.
    /// Whether a list of links (core/links.h) gives the neighbours. The axes give none then.
    bool links = false;

    static const Stencil row, column, plane, volume, linked;

    constexpr int axes() const { return int{x} + int{y} + int{z}; }
    /// A number from 0 to 8 that identifies the stencil.
    constexpr unsigned number() const {
        return unsigned{x} + 2u * unsigned{y} + 4u * unsigned{z} + 8u * unsigned{links};
    }
    friend constexpr bool operator==(const Stencil&, const Stencil&) = default;
};

inline constexpr Stencil Stencil::row{true, false, false};
inline constexpr Stencil Stencil::column{false, true, false};
inline constexpr Stencil Stencil::plane{true, true, false};
inline constexpr Stencil Stencil::volume{true, true, true};
inline constexpr Stencil Stencil::linked{false, false, false, true};

/// The number of cells along each axis.
struct GridSize {
    std::int64_t width = 1;
    std::int64_t height = 1;
    std::int64_t depth = 1;
    friend bool operator==(const GridSize&, const GridSize&) = default;
};

/// A grid of width × height × depth square or cubic cells of side `spacing`. N is the row above (j
/// − 1), E the next column (i + 1), D the next slice (k + 1).
struct Grid {
    std::int64_t width = 64;
    std::int64_t height = 64;
    Boundaries boundary = {};
    std::int64_t depth = 1;
    double spacing = 1;  ///< In the user's unit of length; above 0.
    /// Whether the cells lie on a surface. They are stored row after row, and padding cells may
    /// fill the last row.
    bool linked = false;

    std::int64_t cell_count() const { return width * height * depth; }
    std::int64_t longest_side() const { return std::max({width, height, depth}); }
    /// A grid of one cell has the stencil of a row, with the cell itself as both neighbours.
    Stencil stencil() const {
        if (linked) return Stencil::linked;
        return {width > 1 || (height == 1 && depth == 1), height > 1, depth > 1};
    }
    friend bool operator==(const Grid&, const Grid&) = default;
};

/// The memory layout of a plane: slices one after the other, each with `height` rows and one halo
/// row above and below. A row starts on a multiple of `row_pad` elements and has `row_pad` elements
/// before it and at least `row_pad` after it, so that a vector at the end of a row touches no cells
/// of another row. Columns −1 and `width` and rows −1 and `height` are the halo, including edges
/// and corners. A grid of several slices also has the halo slices −1 and `depth`.
///
/// Rows are numbered through all slices: row r is row r % height of slice r / height.
///
/// A plane may hold only a part of the grid: some rows or, in a grid of several slices, some
/// slices. Its cells keep their numbers in the grid, so positions, random numbers and row sums are
/// the same in any part, and kernels do not depend on the part. The halo then surrounds the part.
struct PlaneLayout {
    static constexpr std::int64_t row_pad = 16;

    std::int64_t width =
        0;  ///< The width, height and depth of the whole grid, even if the plane holds a part.
    std::int64_t height = 0;
    std::int64_t depth = 0;
    /// The rows in memory, without the halo. In a grid of several slices they form whole slices.
    RowRange rows;
    /// Number of elements from a row to the next; a multiple of `row_pad`.
    std::int64_t stride = 0;
    /// Number of elements from a slice to the next; a multiple of `stride`.
    std::int64_t slice_stride = 0;
    /// The number of the grid's elements before the part that the plane holds. 0 if the plane holds
    /// the whole grid.
    std::int64_t elements_before = 0;

    PlaneLayout() = default;
    explicit PlaneLayout(const Grid& grid)
        : PlaneLayout(grid, RowRange{0, grid.height * grid.depth}) {}
    PlaneLayout(const Grid& grid, RowRange part)
        : width(grid.width),
          height(grid.height),
          depth(grid.depth),
          rows(part),
          stride((grid.width + row_pad - 1) / row_pad * row_pad + 2 * row_pad),
          slice_stride((grid.height + 2) * stride),
          elements_before(row_start(part.begin)) {}

    bool has_halo_slices() const { return depth > 1; }
    std::int64_t row_count() const { return height * depth; }
    /// The number of rows in memory from one slice to the next.
    std::int64_t slice_rows() const { return height + 2; }
    /// Whether memory holds the halo before the first row or slice of the grid.
    bool has_first() const { return rows.begin <= 0; }
    /// Whether memory holds the halo after the last row or slice of the grid.
    bool has_last() const { return rows.end >= row_count(); }

    /// The number of elements from cell (0, 0, 0) to the first cell of a row. Rows are numbered
    /// through all slices.
    std::int64_t row_start(std::int64_t row) const {
        if (depth <= 1) return row * stride;
        return row / height * slice_stride + row % height * stride;
    }
    /// Index of the element of cell (column i, row j, slice k) in the allocation.
    std::int64_t offset(std::int64_t i, std::int64_t j, std::int64_t k = 0) const {
        return (k + (has_halo_slices() ? 1 : 0)) * slice_stride + (j + 1) * stride + row_pad + i -
               elements_before;
    }
    /// The number of elements to allocate.
    std::int64_t size() const {
        if (!has_halo_slices()) return (rows.count() + 2) * stride;
        return (rows.count() / height + 2) * slice_stride;
    }

    friend bool operator==(const PlaneLayout&, const PlaneLayout&) = default;
};

}  // namespace cascade
