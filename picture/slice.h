// Cuts plane slices out of volumes, for pictures.
#pragma once

#include "core/axis.h"
#include "core/plane.h"

#include <cstdint>

namespace cascade {

/// A slice perpendicular to an axis. `place` is the position along the axis, from 0 for the first
/// cell to 1 for the last.
struct Slice {
    Axis axis = Axis::z;
    double place = 0.5;
    friend bool operator==(const Slice&, const Slice&) = default;
};

/// The index of the slice's cells along the slice's axis: floor(place · cells), or the last index
/// if `place` is 1.
std::int64_t slice_number(const PlaneLayout& layout, Slice slice);

/// The grid of a slice's picture. A slice perpendicular to z has x along columns and y along rows.
/// A slice perpendicular to y has x along columns and z along rows. A slice perpendicular to x has
/// z along columns and y along rows.
Grid slice_grid(const PlaneLayout& layout, Slice slice);

/// The values of a slice, as a field on the grid that slice_grid() returns. The halo is 0.
Field cut(const Field& field, Slice slice);

}  // namespace cascade
