// Before spreading cells over the copy, moves the copy's points back to the original surface,
// because the copy's area would be too small otherwise.
#include "surface/cells_by_copy.h"

#include "mesh/coarse_copy.h"
#include "surface/nearest_place.h"
#include "surface/relax.h"
#include "surface/scatter.h"
#include "surface/voronoi_cells.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace cascade {

namespace {

/// A surface with at least this many triangles per cell counts as fine. Relaxation unfolds a patch
/// of about twenty cells around each cell. On a fine surface this would take most of the time.
constexpr std::size_t fine_triangles = 12;
/// The copy's approximate number of triangles per cell.
constexpr double coarse_triangles = 3;
/// The approximate mean area of coarse_copy()'s triangles for edges of length 1.
constexpr double area_of_edge = 0.82;

/// Moves positions on a coarse copy to the original. Searches only the original triangles whose
/// points have merged into the corners of the copy's triangle, so it never finds another sheet of
/// the surface.
class WayBack {
public:
    WayBack(const SurfaceMesh& mesh, const CoarseCopy& copy)
        : mesh_(mesh), copy_(copy), ends_(copy.mesh.points.size() + 1) {
        each_merged([&](std::uint32_t point, std::uint32_t) { ++ends_[point + 1]; });
        std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
        triangles_.resize(ends_.back());
        // ends_ now has the start of each point's triangles. Filling the lists moves each start to
        // its end.
        ends_.pop_back();
        each_merged([&](std::uint32_t point, std::uint32_t t) { triangles_[ends_[point]++] = t; });
    }

    /// The original's triangles that have a corner merged into this point of the copy.
    std::span<const std::uint32_t> triangles_of(std::uint32_t point) const {
        const std::size_t first = point == 0 ? 0 : ends_[point - 1];
        return {triangles_.data() + first, ends_[point] - first};
    }

    SurfacePlace place(const SurfacePlace& on_copy) const {
        return nearest(position_of(copy_.mesh, on_copy), copy_.mesh.triangles[on_copy.triangle],
                       copy_.mesh.double_area_normal(on_copy.triangle));
    }
    SurfacePlace place_of_point(std::uint32_t point) const {
        return nearest(copy_.mesh.points[point], std::span(&point, 1), {});
    }

private:
    template <typename Visit>
    void each_merged(const Visit& visit) const {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto [a, b, c] = mesh_.triangles[t];
            const std::uint32_t p = copy_.merged[a], q = copy_.merged[b], r = copy_.merged[c];
            visit(p, t);
            if (q != p) visit(q, t);
            if (r != p && r != q) visit(r, t);
        }
    }

    /// The nearest position on the triangles around these points. Leaves out triangles that face
    /// away from `normal`.
    SurfacePlace nearest(Vector3d position, std::span<const std::uint32_t> points,
                         Vector3d normal) const {
        SurfacePlace best = {triangles_of(points[0])[0], {1, 0, 0}};
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t point : points) {
            for (const std::uint32_t t : triangles_of(point)) {
                if (dot(mesh_.double_area_normal(t), normal) < 0) continue;
                const SurfacePlace place = {
                    t, nearest_weights({mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)},
                                       position)};
                const Vector3d apart = position_of(mesh_, place) - position;
                if (dot(apart, apart) >= least) continue;
                least = dot(apart, apart);
                best = place;
            }
        }
        return best;
    }

    const SurfaceMesh& mesh_;
    const CoarseCopy& copy_;
    std::vector<std::size_t> ends_;  ///< The triangles of point p end before triangles_[ends_[p]].
    std::vector<std::uint32_t> triangles_;  ///< The triangles of each point of the copy.
};

class CellsByCopy {
public:
    CellsByCopy(const SurfaceMesh& mesh, CoarseCopy& copy, Team& team,
                const std::atomic<bool>& cancel)
        : mesh_(mesh),
          copy_(copy),
          team_(team),
          cancel_(cancel),
          back_(mesh, copy),
          components_(connected_components(copy.mesh)) {}

    SurfaceCells make(const CellOptions& options) {
        for (std::uint32_t p = 0; p < copy_.mesh.points.size(); ++p) {
            copy_.mesh.points[p] = position_of(mesh_, back_.place_of_point(p));
        }
        const std::vector<double> areas = areas_of_components();
        std::vector<SurfacePlace> places =
            scatter(copy_.mesh, static_cast<std::size_t>(options.count), options.seed, areas);
        Anisotropy copied;
        if (options.anisotropy) copied = copy_of(*options.anisotropy);
        const Anisotropy* anisotropy = options.anisotropy ? &copied : nullptr;
        relax(copy_.mesh, places, options.rounds, team_, cancel_, anisotropy, options.progress);
        SurfaceCells cells =
            voronoi_cells(copy_.mesh, std::move(places), team_, cancel_, anisotropy);
        if (cancel_) return cells;
        scale(cells, areas);
        for (SurfacePlace& place : cells.places) place = back_.place(place);
        return cells;
    }

private:
    /// The areas of the original's components, in the order of the copy's components.
    std::vector<double> areas_of_components() const {
        const std::vector<std::uint32_t> components = connected_components(mesh_);
        std::vector<double> areas(components_.size()), in_order;
        for (std::uint32_t t = 0; t < components.size(); ++t) {
            areas[components[t]] += mesh_.area(t);
        }
        for (std::uint32_t t = 0; t < components_.size(); ++t) {
            if (components_[t] < in_order.size()) continue;
            const auto there = back_.triangles_of(copy_.mesh.triangles[t][0]);
            in_order.push_back(areas[components[there[0]]]);
        }
        return in_order;
    }

    Anisotropy copy_of(const Anisotropy& anisotropy) const {
        Anisotropy copied;
        for (std::uint32_t t = 0; t < copy_.mesh.triangles.size(); ++t) {
            const std::uint32_t there = back_.place({t, {1.0 / 3, 1.0 / 3, 1.0 / 3}}).triangle;
            copied.direction.push_back(anisotropy.direction[there]);
            copied.ratio.push_back(anisotropy.ratio[there]);
        }
        return copied;
    }

    /// Scales the areas of each component's cells to the component's area on the original.
    void scale(SurfaceCells& cells, const std::vector<double>& areas) const {
        std::vector<double> factors(areas.size());
        const auto component = [&](std::size_t cell) {
            return components_[cells.places[cell].triangle];
        };
        for (std::size_t cell = 0; cell < cells.places.size(); ++cell) {
            factors[component(cell)] += cells.areas[cell];
        }
        for (std::size_t k = 0; k < areas.size(); ++k) factors[k] = areas[k] / factors[k];
        std::size_t edge = 0;
        for (std::size_t cell = 0; cell < cells.places.size(); ++cell) {
            const double factor = factors[component(cell)], root = std::sqrt(factor);
            cells.areas[cell] *= factor;
            for (; edge < cells.ends[cell]; ++edge) {
                cells.edges[edge].length *= root;
                cells.edges[edge].distance *= root;
            }
        }
    }

    const SurfaceMesh& mesh_;
    CoarseCopy& copy_;
    Team& team_;
    const std::atomic<bool>& cancel_;
    WayBack back_;
    std::vector<std::uint32_t> components_;  ///< The component of each triangle of the copy.
};

}  // namespace

bool is_fine(const SurfaceMesh& mesh, const CellOptions& options) {
    return mesh.triangles.size() / fine_triangles >= options.count;
}

Result<SurfaceCells> cells_by_copy(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                   const std::atomic<bool>& cancel) {
    const double triangles = coarse_triangles * static_cast<double>(options.count);
    Result<CoarseCopy> copy =
        coarse_copy(mesh, std::sqrt(mesh.total_area() / triangles / area_of_edge));
    if (!copy) return tl::unexpected(copy.error());
    return CellsByCopy(mesh, *copy, team, cancel).make(options);
}

}  // namespace cascade
