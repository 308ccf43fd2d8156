// Triangles cut from lattices of rectangles, with texture coordinates (internal to mesh/).
#pragma once

#include "mesh/edge_pairs.h"

#include <array>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace cascade {

/// A full turn in radians.
inline constexpr double tau = 2 * std::numbers::pi;

/// Cuts rectangle (i, j) of a lattice into two triangles. Adjacent rectangles are cut along
/// different diagonals, so that no direction is preferred.
template <typename Corner>
void cut_rectangle(std::size_t i, std::size_t j, const Corner& corner) {
    const std::array<std::pair<std::size_t, std::size_t>, 4> ring = {
        {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
    const std::size_t first = (i + j) % 2;
    for (const std::size_t k : {first + 1, first + 2}) {
        for (const std::size_t c : {first, k, k + 1}) corner(ring[c % 4].first, ring[c % 4].second);
    }
}

/// Assembles triangles from a sequence of corners.
struct TriangleList {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<TexturePlace, 3>> texture;

    void add(std::uint32_t point, double u, double v) {
        if (count == 0) {
            triangles.emplace_back();
            texture.emplace_back();
        }
        triangles.back()[count] = point;
        texture.back()[count] = {static_cast<float>(u), static_cast<float>(v)};
        count = (count + 1) % 3;
    }
    std::size_t count = 0;  ///< The number of corners of the current triangle.
};

inline SurfaceMesh mesh_of(std::vector<Vector3d> points, TriangleList list) {
    SurfaceMesh mesh = mesh_of(std::move(points), std::move(list.triangles));
    mesh.texture = std::move(list.texture);
    return mesh;
}

/// A closed tube: n rings of m points each. `place(i, j)` is point j of ring i. The first texture
/// coordinate runs along the tube, the second around it.
template <typename Place>
SurfaceMesh ring_lattice(std::uint32_t n, std::uint32_t m, const Place& place) {
    const double columns = n, rows = m;
    std::vector<Vector3d> points;
    TriangleList list;
    for (std::uint32_t j = 0; j < m; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            points.push_back(place(i, j));
            cut_rectangle(i, j, [&](std::size_t column, std::size_t row) {
                list.add(static_cast<std::uint32_t>(row % m * n + column % n),
                         static_cast<double>(column) / columns, static_cast<double>(row) / rows);
            });
        }
    }
    return mesh_of(std::move(points), std::move(list));
}

}  // namespace cascade
