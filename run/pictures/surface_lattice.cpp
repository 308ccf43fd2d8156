// Evaluates the surface at the corners of the lattice.
#include "run/pictures/surface_lattice.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

/// Averages the normals at joined sides if the positions of both sides coincide in space.
void join_normals(TriangleMesh& mesh, const SurfaceLattice& lattice) {
    const Box box = bounds(mesh);
    const float near = 1e-4F * length(box.high - box.low);
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        if (length(mesh.positions[a] - mesh.positions[b]) > near) return;
        const Vector3 sum = unit(mesh.normals[a] + mesh.normals[b]);
        mesh.normals[a] = mesh.normals[b] = sum;
    };
    const std::uint32_t width = lattice.columns + 1;
    for (std::uint32_t j = 0; lattice.is_periodic_x && j <= lattice.rows; ++j) {
        join(j * width, j * width + lattice.columns);
    }
    for (std::uint32_t i = 0; lattice.is_periodic_y && i <= lattice.columns; ++i) {
        join(i, lattice.rows * width + i);
    }
}

}  // namespace

TriangleMesh surface_lattice(const SurfaceFunction& surface, const SurfaceLattice& lattice) {
    const auto [columns, rows, is_periodic_x, is_periodic_y] = lattice;
    TriangleMesh mesh;
    mesh.positions.reserve(std::size_t{columns + 1} * (rows + 1));
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i <= columns; ++i) {
            const Position p =
                surface(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
            mesh.positions.push_back(
                {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
        }
    }
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const std::uint32_t corner = j * (columns + 1) + i;
            mesh.triangles.push_back({corner, corner + 1, corner + columns + 2});
            mesh.triangles.push_back({corner, corner + columns + 2, corner + columns + 1});
        }
    }
    smooth_normals(mesh);
    join_normals(mesh, lattice);
    return mesh;
}

BetweenCells::BetweenCells(double s, std::int64_t side, bool is_periodic) {
    const double place = s * static_cast<double>(side) - 0.5;
    const double below = std::floor(place);
    const auto cell = static_cast<std::int64_t>(below);
    const auto inside = [&](std::int64_t i) {
        return is_periodic ? (i + side) % side : std::clamp<std::int64_t>(i, 0, side - 1);
    };
    first = inside(cell);
    second = inside(cell + 1);
    part = static_cast<float>(place - below);
}

}  // namespace cascade
