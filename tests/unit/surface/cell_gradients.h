// Gradients of values in cells, computed with the weights of surface/cell_gradient.h.
#pragma once

#include "surface/cell_gradient.h"

#include <span>
#include <vector>

namespace cascade {

/// The gradient in each cell of one value per cell.
inline std::vector<Vector3d> cell_gradients(const SurfaceCells& cells,
                                            std::span<const Vector3d> weights,
                                            std::span<const double> values) {
    std::vector<Vector3d> gradients(cells.places.size());
    std::size_t at = 0;
    for (std::size_t cell = 0; cell < gradients.size(); ++cell) {
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            gradients[cell] =
                gradients[cell] + weights[at++] * (values[edge.neighbour] - values[cell]);
        }
    }
    return gradients;
}

}  // namespace cascade
