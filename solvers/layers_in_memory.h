// The memory of whole layers of planes. Parts of a grid send each other such layers.
#pragma once

#include "core/plane.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cascade {

/// The number of rows in a layer. Parts consist of layers: slices if the grid has several, else
/// rows.
std::int64_t rows_of_layer(const PlaneLayout& layout);
/// All rows in a plane's memory, halo included.
RowRange held(const PlaneLayout& layout);
/// The rows that two ranges share. Empty if they share no rows.
inline RowRange common(RowRange one, RowRange other) {
    return {std::max(one.begin, other.begin), std::min(one.end, other.end)};
}
/// The memory of whole layers, including their halo columns and, if layers are slices, their halo
/// rows. The plane must hold these rows. Successive layers are successive in memory.
std::span<std::byte> memory_of(Field& field, RowRange rows);
std::span<const std::byte> memory_of(const Field& field, RowRange rows);

}  // namespace cascade
