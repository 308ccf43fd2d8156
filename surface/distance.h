// How far places of a surface are from given ones, along the surface.
#pragma once

#include "surface/refinement.h"
#include "surface/voronoi_cells.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

struct DistanceOptions {
    /// The mesh is refined to about this many triangles of equal size where its own are larger.
    std::size_t triangles = 30'000;
};

/// The length of the shortest way along the surface from the nearest of some places, the sources.
///
/// A front goes over the mesh as in Dijkstra's algorithm. What reaches an edge is taken to come from
/// one place: the point of the plane of the next triangle that is as far from the ends of the edge as
/// was found, and it is followed straight to the third corner (M. Novotni and R. Klein, "Computing
/// geodesic distances on triangular meshes", WSCG 2002). A point that is reached by a shorter way later is visited
/// again, so that obtuse angles need no care. This is exact where the surface can be unfolded without a cut, and
/// much nearer than a plane front (R. Kimmel and J. Sethian, "Computing geodesic paths on manifolds",
/// PNAS 95, 1998) on curved ones; exact windows (J. Mitchell, D. Mount and C. Papadimitriou, "The
/// discrete geodesic problem", 1987) take much longer. Errors are of the order of a triangle's size only where
/// ways of equal length from different directions meet. Time is n log n; the same whatever the number of
/// threads.
///
/// What hangs together with no source is infinitely far. Means nothing if `cancel` became true.
class SurfaceDistance {
public:
    static constexpr std::uint32_t no_source = 0xffffffff;
    struct Reach {
        double distance = 0;             ///< In units of the model; infinite where nothing leads there.
        std::uint32_t source = no_source;  ///< The number of the nearest source.
    };

    SurfaceDistance(const SurfaceMesh& mesh, std::span<const SurfacePlace> sources,
                    const std::atomic<bool>& cancel, const DistanceOptions& options = {});

    /// At a point of the mesh.
    Reach at_point(std::uint32_t point) const { return reached_[point]; }
    /// At any place of the mesh.
    Reach at(const SurfacePlace& place) const;

private:
    struct LocalSource {
        std::uint32_t triangle = 0;
        std::uint32_t number = 0;
        Vector3d position;
    };
    void spread(const std::atomic<bool>& cancel);
    std::span<const LocalSource> sources_in(std::uint32_t triangle) const;

    Refinement refinement_;
    std::vector<LocalSource> sources_;  ///< By triangles of the refined mesh.
    std::vector<Reach> reached_;        ///< Of the points of the refined mesh.
};

/// The distance of each cell's place.
std::vector<double> distances_of_cells(const SurfaceDistance& distance, const SurfaceCells& cells);

}  // namespace cascade
