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
/// A front goes over the mesh as in Dijkstra's algorithm. What reaches an edge is taken to come
/// from one place: the point in the plane of the next triangle that is as far from the ends of the
/// edge as was found; from there it goes straight to the third corner (M. Novotni and R. Klein,
/// "Computing geodesic distances on triangular meshes", WSCG 2002). A point to which a shorter way
/// is found later is visited again, so that obtuse angles need no care. On planes and around the
/// edges of convex bodies this is exact, which plane fronts (R. Kimmel and J. Sethian, "Computing
/// geodesic paths on manifolds", PNAS 95, 1998) are nowhere; exact windows (J. Mitchell, D. Mount
/// and C. Papadimitriou, "The discrete geodesic problem", 1987) take much longer. On curved
/// surfaces the error is of the order of the triangles' size: on a sphere of 30 000 triangles
/// 0.0021 radii in the mean, and ten times that where ways from all directions meet. Time is n log
/// n and does not depend on the number of sources.
///
/// What is not connected with a source is infinitely far. Places must be on the mesh. Means
/// nothing if `cancel` became true.
class SurfaceDistance {
public:
    static constexpr std::uint32_t no_source = 0xffffffff;
    struct Reach {
        double distance = 0;  ///< In units of the model; infinite where nothing leads there.
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
