// A box filled with tetrahedra between the corners and the centres of its cells, and where a
// function changes its sign between them.
//
// Around each face between two cells lie four tetrahedra: the centres on either side, and two
// neighbouring corners of the face. They are those of the body-centred cubic lattice, the roundest
// that fill space all alike. At the box's sides the centre of the face stands in for the centre of
// the missing cell.
#pragma once

#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace cascade {

/// Numbers of a lattice point: of corners and of centres, which are counted from −1, one beyond the
/// cells.
struct LatticePoint {
    std::array<std::int32_t, 3> place{};
    bool is_centre = false;
};

class CentredLattice {
public:
    /// `counts`: cells along each axis, at least 1; no more than 2³⁰ points altogether.
    CentredLattice(Vector3d low, Vector3d high, std::array<std::int32_t, 3> counts)
        : low_(low), high_(high), counts_(counts) {}

    const std::array<std::int32_t, 3>& counts() const { return counts_; }
    Vector3d place_of(const LatticePoint& point) const;

    /// A number for each point, smaller ones for smaller z.
    std::uint32_t number_of(const LatticePoint& point) const;
    LatticePoint point_of(std::uint32_t number) const;

    /// Is the point on a side of the box?
    bool is_at_side(const LatticePoint& point) const;

private:
    Vector3d low_, high_;
    std::array<std::int32_t, 3> counts_;
};

/// The values of a function in one layer of equal z.
struct LatticeLayer {
    std::vector<double> values;  ///< Row by row along x.
};

/// The points of a layer, in order. Centres of layer −1 and beyond the last are those of the box's
/// sides.
std::vector<LatticePoint> layer_points(const CentredLattice& lattice, std::int32_t layer,
                                       bool is_centres);

/// Where the surface crosses an edge of the lattice.
struct Crossing {
    std::uint64_t edge = 0;  ///< The numbers of both its ends, the smaller one first.
    double part = 0;         ///< From the first to the second end, as if the function were linear.

    friend bool operator<(const Crossing& a, const Crossing& b) { return a.edge < b.edge; }
};
inline std::pair<std::uint32_t, std::uint32_t> ends_of(std::uint64_t edge) {
    return {static_cast<std::uint32_t>(edge >> 32), static_cast<std::uint32_t>(edge)};
}

using CrossedTriangles = std::vector<std::array<Crossing, 3>>;

/// Appends the triangles of all tetrahedra at faces of layer `layer` (0 … counts[2] − 1) whose
/// normals point along x or y. `below` and `above` are the corners of layers `layer` and `layer`
/// + 1.
void cross_upright_faces(const CentredLattice& lattice, std::int32_t layer,
                         const LatticeLayer& below, const LatticeLayer& centres,
                         const LatticeLayer& above, CrossedTriangles& triangles);

/// The same at the faces between the cells of layers `layer` − 1 and `layer` (0 … counts[2]).
void cross_level_faces(const CentredLattice& lattice, std::int32_t layer, const LatticeLayer& below,
                       const LatticeLayer& corners, const LatticeLayer& above,
                       CrossedTriangles& triangles);

}  // namespace cascade
