// Plane slices of volumes, for pictures.
#pragma once

#include "core/axis.h"
#include "core/plane.h"

#include <cstdint>

namespace cascade {

/// A slice perpendicular to an axis, at a position along it: 0 is the first cell, 1 the last.
struct Slice {
    Axis axis = Axis::z;
    double place = 0.5;
    friend bool operator==(const Slice&, const Slice&) = default;
};

/// The index of the cell at the slice's position: floor(place · cells), and the last cell at 1.
std::int64_t slice_number(const PlaneLayout& layout, Slice slice);

/// The grid of a slice's picture. Across z, columns are x and rows are y. Across y, columns are x
/// and rows are z. Across x, columns are z and rows are y.
Grid slice_grid(const PlaneLayout& layout, Slice slice);

/// The values of a slice as a field on slice_grid(), with a zero halo.
Field cut(const Field& field, Slice slice);

}  // namespace cascade
