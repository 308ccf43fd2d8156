// A surface of two parameters as a mesh, and the cells around a position on it.
#pragma once

#include "mesh/triangle_mesh.h"
#include "surface/parameter_surface.h"

#include <cstdint>

namespace cascade {

/// Quadrilaterals along the two parameters, and whether the first and last of them are neighbours.
struct SurfaceLattice {
    std::uint32_t columns = 1, rows = 1;
    bool is_periodic_x = false, is_periodic_y = false;
};

/// A mesh of columns × rows quadrilaterals over the square of the parameters, with one position
/// more along each side, row after row. Triangles 2k and 2k + 1 form quadrilateral k. Their first
/// corner is its upper left, their second corner is its upper right and its lower right,
/// respectively. Normals are smooth across joined sides that coincide in space.
TriangleMesh surface_lattice(const SurfaceFunction& surface, const SurfaceLattice& lattice);

/// Two neighbours along an axis, and the relative position of a point between them.
struct BetweenCells {
    std::int64_t first = 0, second = 0;
    float part = 0;

    /// Finds s, 0 … 1, among the centres of `side` cells.
    BetweenCells(double s, std::int64_t side, bool is_periodic);
};

}  // namespace cascade
