// Meshes whose geometry is known.
#pragma once

#include "unit/mesh/soups.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace cascade::test {

inline SurfaceMesh box() { return make_mesh(cube())->mesh; }

/// The square 0..1², made of two triangles.
inline SurfaceMesh square() {
    return make_mesh(soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}))->mesh;
}

/// An octahedron whose triangles are divided into n² each and projected onto the unit sphere.
inline SurfaceMesh sphere(int n) {
    PolygonSoup soup;
    const auto add = [&](Vector3d a, Vector3d b, Vector3d c) {
        for (const Vector3d& p : {a, b, c}) {
            soup.corners.push_back(static_cast<std::uint32_t>(soup.points.size()));
            soup.points.push_back(unit(p));
        }
        soup.ends.push_back(soup.corners.size());
    };
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) {
                const auto at = [&](int i, int j) {
                    return Vector3d{x * (n - i - j), y * i, z * j};
                };
                for (int i = 0; i < n; ++i) {
                    for (int j = 0; i + j < n; ++j) {
                        add(at(i, j), at(i + 1, j), at(i, j + 1));
                        if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
                    }
                }
            }
        }
    }
    return make_mesh(std::move(soup))->mesh;
}

/// A sheet of columns × rows squares. The corner (u, v) of 0..1² is at `place(u, v)`. Each square
/// is divided along one diagonal. Sides that coincide are joined.
inline SurfaceMesh sheet(int columns, int rows,
                         const std::function<Vector3d(double, double)>& place) {
    PolygonSoup soup;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            soup.points.push_back(
                place(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    const auto add = [&](std::initializer_list<std::uint32_t> corners) {
        for (const std::uint32_t corner : corners) soup.corners.push_back(corner);
        soup.ends.push_back(soup.corners.size());
    };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            add({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            add({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return make_mesh(std::move(soup))->mesh;
}

/// A point on the unit circle, a full turn for u in 0..1, with the same bits at both ends.
inline Vector3d on_circle(double u) {
    const double angle = 2 * std::numbers::pi * (u == 1 ? 0 : u);
    return {std::cos(angle), std::sin(angle), 0};
}

/// The side of a cylinder around the z axis, from z = 0 to z = height, facing outwards.
inline SurfaceMesh cylinder(int columns, int rows, double radius, double height) {
    return sheet(columns, rows, [&](double u, double v) {
        return on_circle(u) * radius + Vector3d{0, 0, height * v};
    });
}

/// A torus around the z axis: a tube of radius `tube`, whose middle line has the radius `ring`.
inline SurfaceMesh torus(int columns, int rows, double ring, double tube) {
    return sheet(columns, rows, [&](double u, double v) {
        const Vector3d out = on_circle(u), up = on_circle(v);
        return out * (ring + tube * up.x) + Vector3d{0, 0, tube * up.y};
    });
}

}  // namespace cascade::test
