// Computes the size of maps from the wanted number of texels for each cell.
#pragma once

#include "atlas/unwrap.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>

namespace cascade {

/// Returns the side of maps, in texels, at which the average cell is at least `texels_per_cell`
/// texels wide. The side is a power of 2. `covered` is the fraction of the map that the cells
/// cover, which must be above 0.
std::int64_t map_side(double texels_per_cell, std::int64_t cells, double covered);

struct MapSize {
    std::int64_t side = 0;  ///< In texels. The longer side for a plane.
    std::string remark;     ///< A remark for the user.
    /// Whether even the largest maps have fewer texels for each cell than requested.
    bool is_short = false;
};

/// Computes the size for a simulation on a plane or on a model. `texture` replaces the model's
/// texture coordinates unless it is empty. The side is at least 1 and at most
/// ModelFileOptions::most_texels. Throws std::bad_alloc.
MapSize map_size_for(double texels_per_cell, const Simulation& simulation,
                     const MeshTexture& texture);

}  // namespace cascade
