// The size of maps from the number of texels that are wanted along a cell.
#pragma once

#include "atlas/unwrap.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The side of maps in texels, a power of 2 and at least 1, at which a cell is at least
/// `texels_per_cell` texels wide in the mean. A fraction `covered` of the map, above 0, shows all
/// cells.
std::int64_t map_side(double texels_per_cell, std::int64_t cells, double covered);

struct MapSize {
    std::int64_t side = 0;  ///< In texels; of a plane the longer side.
    std::string remark;     ///< What is to be said of it.
    bool is_short = false;  ///< The largest maps have fewer texels.
};

/// Of a simulation on a plane, or on a model with these texture coordinates, or its own if there
/// are none. At least 1 and at most ModelFileOptions::most_texels. Throws std::bad_alloc.
MapSize map_size_for(double texels_per_cell, const Simulation& simulation,
                     const MeshTexture& texture);

}  // namespace cascade
