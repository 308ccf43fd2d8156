// Computes the size of maps from the wanted number of texels for each cell.
#pragma once

#include "atlas/unwrap.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The side of maps in texels at which the average cell is at least `texels_per_cell` texels wide.
/// It is a power of 2. The cells fill the fraction `covered` of the map, which must be above 0.
std::int64_t map_side(double texels_per_cell, std::int64_t cells, double covered);

struct MapSize {
    std::int64_t side = 0;  ///< In texels; for a plane the longer side.
    std::string remark;     ///< A remark for the user.
    /// Whether even the largest maps have fewer texels for each cell than requested.
    bool is_short = false;
};

/// The size for a simulation on a plane or on a model. `texture` replaces the model's texture
/// coordinates unless it is empty. The side is at least 1 and at most
/// ModelFileOptions::most_texels. Throws std::bad_alloc.
MapSize map_size_for(double texels_per_cell, const Simulation& simulation,
                     const MeshTexture& texture);

}  // namespace cascade
