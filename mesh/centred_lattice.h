// A box divided into cells and filled with tetrahedra, whose corners are the corners and the
// centres of cells. Finds where the zero set of a function crosses the tetrahedra's edges.
//
// Each face between two cells has four tetrahedra around it. The corners of each tetrahedron are
// the centres of the two cells and two adjacent corners of the face. This is the body-centred cubic
// lattice. Among tetrahedra whose copies fill space, its tetrahedra are the most regular. At the
// box's sides the centre of the face replaces the centre of the missing cell.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace cascade {

/// Indices of a lattice point. The indices of centres start at −1, before the first cell.
struct LatticePoint {
    std::array<std::int32_t, 3> place{};
    bool is_centre = false;
};

class CentredLattice {
public:
    /// `counts` has the numbers of cells along each axis, at least 1. The lattice may have at most
    /// 2³⁰ points.
    CentredLattice(Vector3d low, Vector3d high, std::array<std::int32_t, 3> counts)
        : low_(low), high_(high), counts_(counts) {}

    const std::array<std::int32_t, 3>& counts() const { return counts_; }
    Vector3d place_of(const LatticePoint& point) const;

    /// The number of a point. Points with larger z have larger numbers.
    std::uint32_t number_of(const LatticePoint& point) const;
    LatticePoint point_of(std::uint32_t number) const;

    /// Whether the point is on a side of the box.
    bool is_at_side(const LatticePoint& point) const;

private:
    Vector3d low_, high_;
    std::array<std::int32_t, 3> counts_;
};

/// The values of a function in one layer of points with equal z.
struct LatticeLayer {
    std::vector<double> values;  ///< Row by row along x.
};

/// The points of a layer of corners or of centres, in the order of LatticeLayer::values. All points
/// in the first and last layers of centres are on the box's sides.
std::vector<LatticePoint> layer_points(const CentredLattice& lattice, std::int32_t layer,
                                       bool is_centres);

/// The crossing of the surface with an edge of the lattice.
struct Crossing {
    std::uint64_t edge = 0;  ///< The numbers of both ends, the smaller one first.
    /// The fraction of the edge before the crossing, interpolated between the values at its ends.
    double part = 0;

    friend bool operator<(const Crossing& a, const Crossing& b) { return a.edge < b.edge; }
};
inline std::pair<std::uint32_t, std::uint32_t> ends_of(std::uint64_t edge) {
    return {static_cast<std::uint32_t>(edge >> 32), static_cast<std::uint32_t>(edge)};
}

using CrossedTriangles = std::vector<std::array<Crossing, 3>>;

/// Appends the triangles of all tetrahedra at faces of layer `layer` (0 … counts[2] − 1) with
/// normals along x or y. `below` and `above` are the corners of layers `layer` and `layer` + 1.
void cross_upright_faces(const CentredLattice& lattice, std::int32_t layer,
                         const LatticeLayer& below, const LatticeLayer& centres,
                         const LatticeLayer& above, CrossedTriangles& triangles);

/// Appends the triangles of all tetrahedra at the faces with normals along z between the cells of
/// layers `layer` − 1 and `layer` (0 … counts[2]).
void cross_level_faces(const CentredLattice& lattice, std::int32_t layer, const LatticeLayer& below,
                       const LatticeLayer& corners, const LatticeLayer& above,
                       CrossedTriangles& triangles);

}  // namespace cascade
