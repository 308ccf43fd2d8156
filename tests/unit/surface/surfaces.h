// Surfaces for tests, with places spread evenly over them and cells around these.
#pragma once

#include "surface/scatter.h"
#include "surface/voronoi_cells.h"
#include "unit/surface/soups.h"

#include <atomic>
#include <vector>

namespace cascade::test {

inline const std::atomic<bool> never = false;

inline SurfaceMesh box() { return make_mesh(cube())->mesh; }

/// A square 0..1² of two triangles.
inline SurfaceMesh square() {
    return make_mesh(soup_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}))->mesh;
}

/// An octahedron whose triangles were cut into n² each and brought to the unit sphere.
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

inline std::vector<SurfacePlace> even_places(const SurfaceMesh& mesh, std::size_t count,
                                             int threads = 2, int rounds = 40) {
    Team team(threads);
    std::vector<SurfacePlace> places = scatter(mesh, count, 1);
    relax(mesh, places, rounds, team, never);
    return places;
}

inline SurfaceCells cells_of(const SurfaceMesh& mesh, std::size_t count, int threads = 2) {
    Team team(threads);
    return voronoi_cells(mesh, even_places(mesh, count, threads), team, never);
}

}  // namespace cascade::test
