// Marching tetrahedra. For each set of corners inside the surface, a table gives the triangles.
#include "mesh/centred_lattice.h"

#include <algorithm>

namespace cascade {

namespace {

/// The number of points in a row. Along an axis there are two more centres than cells, and one more
/// corner.
std::int64_t row_length(const CentredLattice& lattice, std::size_t axis, bool is_centre) {
    return lattice.counts()[axis] + (is_centre ? 2 : 1);
}

/// The index of a point in its layer.
std::size_t index_in_layer(const CentredLattice& lattice, const LatticePoint& point) {
    const std::int64_t shift = point.is_centre ? 1 : 0;
    return static_cast<std::size_t>((point.place[1] + shift) *
                                        row_length(lattice, 0, point.is_centre) +
                                    point.place[0] + shift);
}

std::uint32_t layer_size(const CentredLattice& lattice, bool is_centre) {
    return static_cast<std::uint32_t>(row_length(lattice, 0, is_centre) *
                                      row_length(lattice, 1, is_centre));
}

struct CrossedCorner {
    std::uint32_t number = 0;
    double value = 0;
};
using Tetrahedron = std::array<CrossedCorner, 4>;

Crossing crossing(const CrossedCorner& a, const CrossedCorner& b) {
    if (a.number > b.number) return crossing(b, a);
    return {std::uint64_t{a.number} << 32 | b.number, a.value / (a.value - b.value)};
}

/// Appends the part of the surface within a tetrahedron whose corners 1, 2 and 3 are
/// counterclockwise seen from opposite corner 0: (v₁ − v₀) · (v₂ − v₀) × (v₃ − v₀) > 0. The part is
/// a triangle if the surface separates one corner from the others, and a quadrilateral if it
/// separates two corners from the others. An even permutation moves the single corner to index 0,
/// or the two corners inside to indices 0 and 1. The triangles for these two cases were derived
/// with v₀ at the origin and v₁, v₂, v₃ at the unit vectors.
void cross(const Tetrahedron& v, CrossedTriangles& triangles) {
    unsigned inside = 0;
    for (unsigned k = 0; k < 4; ++k) inside |= (v[k].value > 0 ? 1u : 0u) << k;
    if (inside == 0 || inside == 15) return;
    using Order = std::array<std::uint8_t, 4>;
    constexpr std::array<Order, 4> one_first = {
        {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};
    for (std::uint8_t k = 0; k < 4; ++k) {
        const bool is_inside = inside == 1u << k;
        if (!is_inside && inside != (15u ^ 1u << k)) continue;
        const auto& [a, b, c, d] = one_first[k];
        const Crossing ab = crossing(v[a], v[b]), ac = crossing(v[a], v[c]),
                       ad = crossing(v[a], v[d]);
        if (is_inside) triangles.push_back({ab, ac, ad});
        else triangles.push_back({ab, ad, ac});
        return;
    }
    constexpr std::array<Order, 6> two_first = {
        {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
    for (const auto& [a, b, c, d] : two_first) {
        if (inside != (1u << a | 1u << b)) continue;
        const Crossing ac = crossing(v[a], v[c]), ad = crossing(v[a], v[d]);
        const Crossing bd = crossing(v[b], v[d]), bc = crossing(v[b], v[c]);
        triangles.push_back({ac, ad, bd});
        triangles.push_back({ac, bd, bc});
        return;
    }
}

/// Cuts the tetrahedra around faces of the lattice. The values of points come from given layers.
class FaceCrosser {
public:
    FaceCrosser(const CentredLattice& lattice, CrossedTriangles& triangles)
        : lattice_(lattice), triangles_(triangles) {}

    CrossedCorner corner(const LatticePoint& point, const LatticeLayer& layer) const {
        return {lattice_.number_of(point), layer.values[index_in_layer(lattice_, point)]};
    }
    /// Cuts the four tetrahedra around a face between two centres. `ring` has the face's corners,
    /// counterclockwise seen from the second centre.
    void face(const CrossedCorner& first, const CrossedCorner& second,
              const std::array<CrossedCorner, 4>& ring) {
        for (std::size_t k = 0; k < 4; ++k) {
            cross({first, ring[k], ring[(k + 1) % 4], second}, triangles_);
        }
    }

private:
    const CentredLattice& lattice_;
    CrossedTriangles& triangles_;
};

}  // namespace

Vector3d CentredLattice::place_of(const LatticePoint& point) const {
    const auto coordinate = [&](double low, double high, std::size_t axis) {
        const double step = point.place[axis] + (point.is_centre ? 0.5 : 0.0);
        const double part = std::clamp(step / counts_[axis], 0.0, 1.0);
        return low * (1 - part) + high * part;
    };
    return {coordinate(low_.x, high_.x, 0), coordinate(low_.y, high_.y, 1),
            coordinate(low_.z, high_.z, 2)};
}

// Points are numbered layer by layer: layer −1 of centres, layer 0 of corners, layer 0 of centres,
// … layer n of corners, layer n of centres.

std::uint32_t CentredLattice::number_of(const LatticePoint& point) const {
    const auto layers = static_cast<std::uint32_t>(point.place[2] + (point.is_centre ? 1 : 0));
    const std::uint32_t centres = layer_size(*this, true), corners = layer_size(*this, false);
    const std::uint32_t before = layers * (centres + corners) + (point.is_centre ? 0 : centres);
    return before + static_cast<std::uint32_t>(index_in_layer(*this, point));
}

LatticePoint CentredLattice::point_of(std::uint32_t number) const {
    const std::uint32_t centres = layer_size(*this, true), corners = layer_size(*this, false);
    LatticePoint point;
    std::uint32_t rest = number % (centres + corners);
    point.is_centre = rest < centres;
    if (!point.is_centre) rest -= centres;
    const auto row = static_cast<std::uint32_t>(row_length(*this, 0, point.is_centre));
    const std::int32_t shift = point.is_centre ? 1 : 0;
    point.place = {static_cast<std::int32_t>(rest % row) - shift,
                   static_cast<std::int32_t>(rest / row) - shift,
                   static_cast<std::int32_t>(number / (centres + corners)) - shift};
    return point;
}

bool CentredLattice::is_at_side(const LatticePoint& point) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int32_t first = point.is_centre ? -1 : 0;
        if (point.place[axis] == first || point.place[axis] == counts_[axis]) return true;
    }
    return false;
}

std::vector<LatticePoint> layer_points(const CentredLattice& lattice, std::int32_t layer,
                                       bool is_centres) {
    const std::int32_t first = is_centres ? -1 : 0;
    std::vector<LatticePoint> points;
    points.reserve(layer_size(lattice, is_centres));
    for (std::int32_t y = first; y <= lattice.counts()[1]; ++y) {
        for (std::int32_t x = first; x <= lattice.counts()[0]; ++x) {
            points.push_back({{x, y, layer}, is_centres});
        }
    }
    return points;
}

void cross_upright_faces(const CentredLattice& lattice, std::int32_t layer,
                         const LatticeLayer& below, const LatticeLayer& centres,
                         const LatticeLayer& above, CrossedTriangles& triangles) {
    FaceCrosser crosser(lattice, triangles);
    const std::int32_t z = layer;
    const auto low = [&](std::int32_t x, std::int32_t y) {
        return crosser.corner({{x, y, z}, false}, below);
    };
    const auto high = [&](std::int32_t x, std::int32_t y) {
        return crosser.corner({{x, y, z + 1}, false}, above);
    };
    const auto centre = [&](std::int32_t x, std::int32_t y) {
        return crosser.corner({{x, y, z}, true}, centres);
    };
    for (std::int32_t y = 0; y < lattice.counts()[1]; ++y) {
        for (std::int32_t x = 0; x <= lattice.counts()[0]; ++x) {
            crosser.face(centre(x - 1, y), centre(x, y),
                         {low(x, y), low(x, y + 1), high(x, y + 1), high(x, y)});
        }
    }
    for (std::int32_t y = 0; y <= lattice.counts()[1]; ++y) {
        for (std::int32_t x = 0; x < lattice.counts()[0]; ++x) {
            crosser.face(centre(x, y - 1), centre(x, y),
                         {low(x, y), high(x, y), high(x + 1, y), low(x + 1, y)});
        }
    }
}

void cross_level_faces(const CentredLattice& lattice, std::int32_t layer, const LatticeLayer& below,
                       const LatticeLayer& corners, const LatticeLayer& above,
                       CrossedTriangles& triangles) {
    FaceCrosser crosser(lattice, triangles);
    const auto corner = [&](std::int32_t x, std::int32_t y) {
        return crosser.corner({{x, y, layer}, false}, corners);
    };
    for (std::int32_t y = 0; y < lattice.counts()[1]; ++y) {
        for (std::int32_t x = 0; x < lattice.counts()[0]; ++x) {
            crosser.face(crosser.corner({{x, y, layer - 1}, true}, below),
                         crosser.corner({{x, y, layer}, true}, above),
                         {corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)});
        }
    }
}

}  // namespace cascade
