// Plane slices of volumes, which is how pictures show them.
#pragma once

#include "core/axis.h"
#include "core/plane.h"

#include <cstdint>

namespace cascade {

/// A slice across an axis, at a place along it: 0 is the first cell, 1 the last.
struct Slice {
    Axis axis = Axis::z;
    double place = 0.5;
    friend bool operator==(const Slice&, const Slice&) = default;
};

/// The number of the cell along the slice's axis that holds its place: floor(place · cells), and
/// the last cell at 1.
std::int64_t slice_number(const PlaneLayout& layout, Slice slice);

/// The grid of the picture of a slice: across z columns are x and rows are y; across y columns are
/// x and rows are z; across x columns are z and rows are y.
Grid slice_grid(const PlaneLayout& layout, Slice slice);

/// The values of a slice as a field of slice_grid(); its halo is zero.
Field cut(const Field& field, Slice slice);

}  // namespace cascade
