// A surface in space as a triangle mesh: an oriented manifold with boundary.
//
// Every edge is between two triangles or at a boundary, every point has one fan of triangles, and
// adjacent triangles have the same orientation.
#pragma once

#include "mesh/polygon_soup.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <vector>

namespace cascade {

/// Corners and edges of a triangle are in cyclic order: 0, 1, 2, 0.
template <std::unsigned_integral Index>
constexpr Index corner_after(Index k) {
    return k == 2 ? 0 : k + 1;
}
template <std::unsigned_integral Index>
constexpr Index corner_before(Index k) {
    return k == 0 ? 2 : k - 1;
}

/// An edge of a triangle. Edge k goes from corner k to corner k + 1 (modulo 3).
struct TriangleEdge {
    static constexpr std::uint32_t none = 0xffffffff;
    std::uint32_t triangle = none;
    std::uint32_t edge = 0;

    bool exists() const { return triangle != none; }
    friend bool operator==(const TriangleEdge&, const TriangleEdge&) = default;
};

struct SurfaceMesh {
    std::vector<Vector3d> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Counterclockwise, seen from outside.
    /// For edge k of each triangle: the edge of the adjacent triangle across this edge, if there is
    /// one.
    std::vector<std::array<TriangleEdge, 3>> across;
    /// The texture coordinates of each triangle's corners. Empty if there are no texture
    /// coordinates.
    std::vector<std::array<TexturePlace, 3>> texture;
    std::vector<PointAttribute> attributes;
    /// The face of the model from which each triangle was cut, counted from 0. A merged triangle
    /// without area belongs to its neighbour's face. Empty if the model has only triangles.
    std::vector<std::uint32_t> faces;

    Vector3d corner(std::size_t triangle, std::size_t k) const {
        return points[triangles[triangle][k]];
    }
    /// The outward normal of a triangle. Its length is twice the triangle's area.
    Vector3d double_area_normal(std::size_t triangle) const {
        const Vector3d a = corner(triangle, 0);
        return cross(corner(triangle, 1) - a, corner(triangle, 2) - a);
    }
    double area(std::size_t triangle) const { return length(double_area_normal(triangle)) / 2; }
    Vector3d centroid(std::size_t triangle) const {
        return (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) * (1.0 / 3);
    }
    /// The angle of a triangle at its corner k, 0 … π.
    double angle(std::size_t triangle, std::size_t k) const;
    /// The area of all triangles, summed in their order.
    double total_area() const;
    /// The bounding box of all points.
    struct Box {
        Vector3d low, high;
    };
    Box box() const;
};

/// Global properties of a mesh.
struct MeshFacts {
    std::size_t points = 0, triangles = 0, edges = 0;
    std::size_t components = 0;  ///< The number of parts that are connected over edges.
    std::size_t boundary_edges = 0;
    std::size_t boundaries = 0;             ///< The number of closed loops of boundary edges.
    std::int64_t euler_characteristic = 0;  ///< points − edges + triangles.
    double area = 0;
    Vector3d low, high;  ///< The bounding box.
};
MeshFacts facts_of(const SurfaceMesh& mesh);

/// The component of each triangle, 0 … components − 1, in the order of their first triangles.
std::vector<std::uint32_t> connected_components(const SurfaceMesh& mesh);

}  // namespace cascade
