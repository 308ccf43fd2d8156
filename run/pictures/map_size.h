// The size of maps by the wanted number of texels per cell.
#pragma once

#include "atlas/unwrap.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The side of maps in texels, a power of 2 and at least 1, at which a cell is on average at least
/// `texels_per_cell` texels wide. A fraction `covered` of the map, above 0, shows all cells.
std::int64_t map_side(double texels_per_cell, std::int64_t cells, double covered);

struct MapSize {
    std::int64_t side = 0;  ///< In texels. For a plane the longer side.
    std::string remark;     ///< A remark for the user.
    bool is_short = false;  ///< The largest maps have fewer texels.
};

/// For a simulation on a plane, or on a model with these texture coordinates, or its own if there
/// are none. At least 1 and at most ModelFileOptions::most_texels. Throws std::bad_alloc.
MapSize map_size_for(double texels_per_cell, const Simulation& simulation,
                     const MeshTexture& texture);

}  // namespace cascade
