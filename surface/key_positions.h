// Values on a surface interpolated from a few positions: G. Turk's "Parameter specification using
// diffusion" (thesis, 1992, section 4.6.2).
#pragma once

#include "core/parallel.h"
#include "surface/voronoi_cells.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// A value that is given at one position of the surface: the position nearest to a point in space.
struct KeyValue {
    Vector3d position;
    double value = 0;
};

/// For each cell, the value of the key that is nearest along the surface. In components without a
/// key, the value of the key that is nearest in space. Ignores keys with positions that are not
/// finite. All values are 0 if there are no keys. The result is undefined if `cancel` became true.
std::vector<double> nearest_key_values(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                       std::span<const KeyValue> keys,
                                       const std::atomic<bool>& cancel);

/// Diffuses cell values over the surface, as if convolved with a Gaussian of standard deviation
/// `length`, in units of the model. A length of 0 changes nothing. With an infinite length, every
/// cell gets the mean of its component. Values stay within their original range. Turk's n steps,
/// each exchanging a fraction k of the difference with every neighbour, correspond to a length of
/// √(3 k n) neighbour distances on a hexagonal mesh. Values must be finite. The result is the same
/// with any number of threads. It is undefined if `cancel` became true.
std::vector<double> smoothed(const SurfaceCells& cells, std::vector<double> values, double length,
                             Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
