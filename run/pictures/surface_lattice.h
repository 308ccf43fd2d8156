// Makes a mesh of a surface of two parameters, and finds the cells around a position on it.
#pragma once

#include "mesh/triangle_mesh.h"
#include "surface/parameter_surface.h"

#include <cstdint>

namespace cascade {

/// The numbers of quadrilaterals along both parameters. If an axis is periodic, its first and last
/// quadrilaterals are neighbours.
struct SurfaceLattice {
    std::uint32_t columns = 1, rows = 1;
    bool is_periodic_x = false, is_periodic_y = false;
};

/// Makes a mesh of columns × rows quadrilaterals over the square of the parameters. It has columns
/// + 1 by rows + 1 vertices, row by row. Triangles 2k and 2k + 1 form quadrilateral k. The first
/// corner of both triangles is the upper left corner of the quadrilateral. The second corner is the
/// upper right in the first triangle, and the lower right in the second. Normals are smooth across
/// joined sides that coincide in space.
TriangleMesh surface_lattice(const SurfaceFunction& surface, const SurfaceLattice& lattice);

/// Two neighbouring cells along an axis, and the position of a point between their centres, 0 … 1.
struct BetweenCells {
    std::int64_t first = 0, second = 0;
    float part = 0;

    /// Finds the two cells around a point of the axis, among `side` cells. `s` is the position of
    /// the point along the axis, 0 … 1.
    BetweenCells(double s, std::int64_t side, bool is_periodic);
};

}  // namespace cascade
