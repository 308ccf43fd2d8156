// Places spread evenly on the meshes of these tests, and cells around them.
#pragma once

#include "surface/relax.h"
#include "surface/scatter.h"
#include "surface/voronoi_cells.h"
#include "tests/support/never.h"
#include "unit/mesh/meshes.h"

namespace cascade::test {

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
