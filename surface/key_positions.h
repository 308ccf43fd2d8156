// A value that varies over a surface as a few places say: G. Turk's "Parameter specification using
// diffusion" (thesis, 1992, section 4.6.2).
#pragma once

#include "core/parallel.h"
#include "surface/voronoi_cells.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// A value at the place of the surface that is nearest to a point in space.
struct KeyValue {
    Vector3d position;
    double value = 0;
};

/// For each cell the value of the key that is nearest along the surface; on components without a
/// key, that of the one nearest in space. Keys whose positions are not finite are left out; without
/// keys all is 0. Means nothing if `cancel` became true.
std::vector<double> nearest_key_values(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                       std::span<const KeyValue> keys,
                                       const std::atomic<bool>& cancel);

/// Diffuses values of cells over the surface, as if each were spread by a Gaussian of standard
/// deviation `length`, in units of the model; 0 changes nothing, infinity leaves the mean of each
/// component. Values stay between the least and the largest. Turk's n steps, in each of which a
/// part k of the difference to every neighbour is exchanged, are a length of √(3 k n) distances of
/// neighbours on a mesh of hexagons. Values must be finite. The same on any number of threads;
/// means nothing if `cancel` became true.
std::vector<double> smoothed(const SurfaceCells& cells, std::vector<double> values, double length,
                             Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
