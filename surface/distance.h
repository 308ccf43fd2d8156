// Distances along a surface.
#pragma once

#include "surface/refinement.h"
#include "surface/voronoi_cells.h"

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace cascade {

struct DistanceOptions {
    /// The mesh is refined to about this many triangles of equal area if it is coarser.
    std::size_t triangles = 30'000;
};

/// The shortest distance along the surface from the nearest of some places, the sources.
///
/// A front propagates over the mesh as in Dijkstra's algorithm. The paths to an edge are taken to
/// come from one point: the one in the plane of the next triangle that has the computed distances
/// from the ends of the edge. From there they go straight to the third corner (M. Novotni and R.
/// Klein, "Computing geodesic distances on triangular meshes", WSCG 2002). A point to which a
/// shorter path is found later is visited again, so obtuse angles need no special case. The result
/// is exact on planes and around the edges of convex bodies, where methods with plane fronts (R.
/// Kimmel and J. Sethian, "Computing geodesic paths on manifolds", PNAS 95, 1998) never are; exact
/// windows (J. Mitchell, D. Mount and C. Papadimitriou, "The discrete geodesic problem", 1987) take
/// much longer. On curved surfaces the error is of the order of the triangles' size: on a sphere of
/// 30 000 triangles 0.0021 radii on average, and ten times that where paths from all directions
/// meet. Time is O(n log n), independent of the number of sources.
///
/// Points that are not connected with a source are infinitely far. Places must be on the mesh.
/// Undefined if `cancel` became true.
class SurfaceDistance {
public:
    static constexpr std::uint32_t no_source = 0xffffffff;
    struct Reach {
        double distance = 0;               ///< In units of the model; infinite if no path exists.
        std::uint32_t source = no_source;  ///< The index of the nearest source.
    };

    SurfaceDistance(const SurfaceMesh& mesh, std::span<const SurfacePlace> sources,
                    const std::atomic<bool>& cancel, const DistanceOptions& options = {});

    /// The distance of a point of the mesh.
    Reach at_point(std::uint32_t point) const { return reached_[point]; }
    /// The distance of any place of the mesh.
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
    std::vector<LocalSource> sources_;  ///< By triangle of the refined mesh.
    std::vector<Reach> reached_;        ///< Of the points of the refined mesh.
};

/// The distance of each cell's place.
std::vector<double> distances_of_cells(const SurfaceDistance& distance, const SurfaceCells& cells);

}  // namespace cascade
