#include "surface/voronoi_cells.h"

#include "surface/convex_region.h"
#include "surface/point_index.h"
#include "surface/scatter.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <tuple>

namespace cascade {

namespace {

/// Part of a triangle that a cell claims.
struct Claim {
    std::uint32_t triangle = 0;
    std::uint32_t cell = 0;
    double area = 0;
};

/// A wall as one of its cells sees it.
struct SeenWall {
    std::uint32_t low = 0, high = 0;
    double length = 0;
    double distance = 0;
};

struct Found {
    std::vector<Claim> claims;
    std::vector<SeenWall> walls;
};

/// Finds the regions of some cells; one a thread.
class RegionFinder {
public:
    RegionFinder(const SurfaceMesh& mesh, const std::vector<SurfacePlace>& places,
                 const PointIndex& index, double reach)
        : places_(places), index_(index), reach_(reach), unfolding_(mesh) {}

    void find(std::uint32_t cell, Vector3d position, Found& found) {
        const auto pieces = unfolding_.around(places_[cell], reach_);
        collect_neighbours(cell, position);
        ConvexRegion region = ConvexRegion::square(reach_);
        for (std::uint32_t k = 0; k < neighbours_.size(); ++k) {
            if (neighbours_[k].distance >= 2 * region.farthest()) break;
            region.cut_halfway(neighbours_[k].place, k);
        }
        lengths_.assign(neighbours_.size(), 0);
        const double farthest = region.farthest();
        for (const Unfolding::Piece& piece : pieces) claim(cell, piece, region, farthest, found);
        for (std::size_t k = 0; k < neighbours_.size(); ++k) {
            if (lengths_[k] <= 0) continue;
            const std::uint32_t other = neighbours_[k].number;
            found.walls.push_back({std::min(cell, other), std::max(cell, other), lengths_[k],
                                   neighbours_[k].distance});
        }
    }

private:
    struct Neighbour {
        double distance = 0;
        std::uint32_t number = 0;
        Vector2d place;
    };

    void collect_neighbours(std::uint32_t cell, Vector3d position) {
        neighbours_.clear();
        index_.near(position, [&](std::uint32_t other) {
            const FlatTriangle* flat = unfolding_.flat_of(places_[other].triangle);
            if (other == cell || !flat) return;
            const Vector2d place = position_of(*flat, places_[other].weights);
            const double distance = length(place);
            if (distance > 0) neighbours_.push_back({distance, other, place});
        });
        std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& a, const Neighbour& b) {
            return std::tie(a.distance, a.number) < std::tie(b.distance, b.number);
        });
    }

    void claim(std::uint32_t cell, const Unfolding::Piece& piece, const ConvexRegion& region,
               double farthest, Found& found) {
        const FlatTriangle& flat = piece.flat;
        part_ = region;
        for (std::uint32_t k = 0; k < 3 && !part_.empty(); ++k) {
            const Vector2d from = flat[k], to = flat[(k + 1) % 3];
            if (cross(to - from, Vector2d{} - from) < -farthest * length(to - from)) return;
            part_.cut(from, to, ConvexRegion::nothing);
        }
        const double area = part_.area();
        if (area <= 0) return;
        found.claims.push_back({piece.triangle, cell, area});
        const auto& edges = part_.edges();
        for (std::size_t k = 0; k < edges.size(); ++k) {
            if (edges[k].beyond == ConvexRegion::nothing) continue;
            const Vector2d to = edges[k + 1 == edges.size() ? 0 : k + 1].from;
            lengths_[edges[k].beyond] += length(to - edges[k].from);
        }
    }

    const std::vector<SurfacePlace>& places_;
    const PointIndex& index_;
    double reach_;
    Unfolding unfolding_;
    std::vector<Neighbour> neighbours_;
    std::vector<double> lengths_;  ///< Of the walls to the neighbours.
    ConvexRegion part_;
};

/// The threads' findings one after the other, which is in order of cells.
template <typename T>
std::vector<T> joined(std::vector<Found>& found, std::vector<T> Found::*part) {
    std::vector<T> all;
    for (Found& one : found) {
        all.insert(all.end(), (one.*part).begin(), (one.*part).end());
        std::vector<T>().swap(one.*part);
    }
    return all;
}

void share_areas(const SurfaceMesh& mesh, const std::vector<Claim>& claims, SurfaceCells& cells) {
    std::vector<double> claimed(mesh.triangles.size());
    for (const Claim& claim : claims) claimed[claim.triangle] += claim.area;
    for (const Claim& claim : claims) {
        cells.areas[claim.cell] +=
            claim.area / claimed[claim.triangle] * mesh.area(claim.triangle);
    }
    for (std::size_t t = 0; t < claimed.size(); ++t) {
        if (claimed[t] <= 0) cells.bare_area += mesh.area(t);
    }
}

/// A wall that one cell alone sees is half as long.
void match_walls(std::vector<SeenWall> seen, SurfaceCells& cells) {
    std::sort(seen.begin(), seen.end(), [](const SeenWall& a, const SeenWall& b) {
        return std::tie(a.low, a.high, a.length, a.distance) <
               std::tie(b.low, b.high, b.length, b.distance);
    });
    std::vector<std::pair<std::uint32_t, CellWall>> sided;
    for (std::size_t begin = 0, end = 0; begin < seen.size(); begin = end) {
        double length_sum = 0, distance_sum = 0;
        for (; end < seen.size() && seen[end].low == seen[begin].low &&
               seen[end].high == seen[begin].high;
             ++end) {
            length_sum += seen[end].length;
            distance_sum += seen[end].distance;
        }
        const CellWall wall = {0, length_sum / 2, distance_sum / static_cast<double>(end - begin)};
        sided.push_back({seen[begin].low, {seen[begin].high, wall.length, wall.distance}});
        sided.push_back({seen[begin].high, {seen[begin].low, wall.length, wall.distance}});
    }
    std::sort(sided.begin(), sided.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first, a.second.neighbour) < std::tie(b.first, b.second.neighbour);
    });
    cells.ends.assign(cells.places.size(), 0);
    for (const auto& [cell, wall] : sided) {
        ++cells.ends[cell];
        cells.walls.push_back(wall);
    }
    for (std::size_t k = 1; k < cells.ends.size(); ++k) cells.ends[k] += cells.ends[k - 1];
}

}  // namespace

SurfaceCells voronoi_cells(const SurfaceMesh& mesh, std::vector<SurfacePlace> places, Team& team,
                           const std::atomic<bool>& cancel) {
    SurfaceCells cells;
    cells.places = std::move(places);
    cells.areas.assign(cells.places.size(), 0);
    if (cells.places.empty()) return cells;
    std::vector<Vector3d> positions;
    for (const SurfacePlace& place : cells.places) positions.push_back(position_of(mesh, place));
    const double reach = 2 * repulsion_radius(mesh.total_area(), cells.places.size());
    const PointIndex index(positions, reach);
    std::vector<Found> found(static_cast<std::size_t>(team.size()));
    team.run([&](int thread) {
        const RowRange part =
            split_rows(static_cast<std::int64_t>(cells.places.size()), thread, team.size());
        RegionFinder finder(mesh, cells.places, index, reach);
        for (std::int64_t k = part.begin; k < part.end && !cancel; ++k) {
            const auto cell = static_cast<std::size_t>(k);
            finder.find(static_cast<std::uint32_t>(cell), positions[cell],
                        found[static_cast<std::size_t>(thread)]);
        }
    });
    share_areas(mesh, joined(found, &Found::claims), cells);
    match_walls(joined(found, &Found::walls), cells);
    return cells;
}

}  // namespace cascade
