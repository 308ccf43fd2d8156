// For each cell, unfolds the surroundings and cuts the triangles by the bisectors to the
// neighbours. The results of the two cells of a Voronoi edge are averaged afterwards.
#include "surface/voronoi_cells.h"

#include "surface/convex_region.h"
#include "surface/point_index.h"
#include "surface/relax.h"
#include "surface/unfolding.h"

#include <algorithm>
#include <tuple>

namespace cascade {

namespace {

/// A part of a triangle that a cell claims.
struct Claim {
    std::uint32_t triangle = 0;
    std::uint32_t cell = 0;
    double area = 0;
};

/// The results of one thread, cell after cell.
struct Found {
    std::vector<Claim> claims;
    /// As each cell has found them. A cell's edges are sorted by neighbour.
    std::vector<VoronoiEdge> edges;
};

/// Finds the regions of some cells. One object per thread.
class RegionFinder {
public:
    RegionFinder(const SurfaceMesh& mesh, const EdgeShapes& shapes,
                 const std::vector<SurfacePlace>& places, const std::vector<Vector3d>& positions,
                 const PointIndex& index, const Anisotropy* anisotropy)
        : mesh_(mesh),
          places_(places),
          positions_(positions),
          index_(index),
          anisotropy_(anisotropy),
          unfolding_(mesh, shapes) {}

    /// Finds the region of a cell. Unfolds the whole part of the surface that affects the region,
    /// at least as far as `reach`.
    void find(std::uint32_t cell, double reach, Found& found) {
        position_ = positions_[cell];
        double ratio = 1;
        if (anisotropy_) {
            stretch_ = anisotropy_->of(mesh_, places_[cell].triangle);
            ratio = anisotropy_->ratio_of(places_[cell].triangle);
        }
        const std::size_t claims = found.claims.size();
        for (;; reach *= 2) {
            // Points within `reach` in the anisotropic metric are within `wide` on the surface.
            const double wide = reach * std::sqrt(ratio);
            const auto pieces = unfolding_.around(places_[cell], wide);
            collect_neighbours(cell, wide);
            const double farthest = claim_all(cell, pieces, reach, found);
            if (2 * farthest <= reach) break;
            if (unfolding_.is_everything() && reach >= 2 * size_of(pieces)) break;
            found.claims.resize(claims);
        }
        const std::size_t edges = found.edges.size();
        for (std::size_t k = 0; k < neighbours_.size(); ++k) {
            if (lengths_[k] <= 0) continue;
            found.edges.push_back({neighbours_[k].number, lengths_[k], neighbours_[k].distance});
        }
        std::sort(found.edges.begin() + static_cast<std::ptrdiff_t>(edges), found.edges.end(),
                  [](const VoronoiEdge& a, const VoronoiEdge& b) {
                      return a.neighbour < b.neighbour;
                  });
    }

private:
    struct Neighbour {
        double distance = 0;
        std::uint32_t number = 0;
        Vector2d place;
    };

    /// The distance from the cell to the farthest corner of a patch.
    double size_of(std::span<const Unfolding::Piece> pieces) const {
        double size = 0;
        for (const Unfolding::Piece& piece : pieces) {
            for (const Vector2d& corner : piece.flat)
                size = std::max(size, length(stretch_(corner)));
        }
        return size;
    }

    void collect_neighbours(std::uint32_t cell, double wide) {
        neighbours_.clear();
        index_.near(position_, wide, [&](std::uint32_t other, double square_in_space) {
            const FlatTriangle* flat = unfolding_.flat_of(places_[other].triangle);
            if (other == cell || !flat) return;
            const Vector2d image = position_of(*flat, places_[other].weights);
            if (!Unfolding::is_image(dot(image, image), square_in_space)) return;
            const Vector2d place = stretch_(image);
            const double distance = length(place);
            if (distance > 0) neighbours_.push_back({distance, other, place});
        });
        std::sort(neighbours_.begin(), neighbours_.end(),
                  [](const Neighbour& a, const Neighbour& b) {
                      return std::tie(a.distance, a.number) < std::tie(b.distance, b.number);
                  });
    }

    /// Claims all points that are nearer to the cell than to its neighbours. Returns the distance
    /// of the farthest claimed point.
    double claim_all(std::uint32_t cell, std::span<const Unfolding::Piece> pieces, double reach,
                     Found& found) {
        ConvexRegion region = ConvexRegion::square(reach);
        for (std::uint32_t k = 0; k < neighbours_.size(); ++k) {
            if (neighbours_[k].distance >= 2 * region.farthest()) break;
            region.cut_halfway(neighbours_[k].place, k);
        }
        lengths_.assign(neighbours_.size(), 0);
        const double size = region.farthest();
        double farthest = 0;
        for (const Unfolding::Piece& piece : pieces) {
            claim(cell, piece, region, size, found);
            farthest = std::max(farthest, part_.farthest());
        }
        return farthest;
    }

    void claim(std::uint32_t cell, const Unfolding::Piece& piece, const ConvexRegion& region,
               double size, Found& found) {
        const FlatTriangle flat = {stretch_(piece.flat[0]), stretch_(piece.flat[1]),
                                   stretch_(piece.flat[2])};
        part_.clear();
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vector2d from = flat[k], along = flat[corner_after(k)] - from;
            const double side = cross(from, along);
            if (side < 0 && side * side > size * size * dot(along, along)) return;
        }
        part_ = region;
        for (std::uint32_t k = 0; k < 3 && !part_.empty(); ++k) {
            part_.cut(flat[k], flat[corner_after(k)], ConvexRegion::nothing);
        }
        const double area = part_.area();
        if (area <= 0 || !is_image(part_.middle(), piece, flat)) {
            part_.clear();
            return;
        }
        found.claims.push_back({piece.triangle, cell, area});
        const auto& edges = part_.edges();
        for (std::size_t k = 0; k < edges.size(); ++k) {
            if (edges[k].beyond == ConvexRegion::nothing) continue;
            const Vector2d to = edges[k + 1 == edges.size() ? 0 : k + 1].from;
            lengths_[edges[k].beyond] += length(to - edges[k].from);
        }
    }

    /// Whether a point of a piece, in stretched coordinates, can be the image of the corresponding
    /// point of the surface.
    bool is_image(Vector2d point, const Unfolding::Piece& piece, const FlatTriangle& flat) const {
        const SurfacePlace place = {piece.triangle, weights_at(flat, point)};
        const Vector2d image = position_of(piece.flat, place.weights);
        const Vector3d apart = position_of(mesh_, place) - position_;
        return Unfolding::is_image(dot(image, image), dot(apart, apart));
    }

    const SurfaceMesh& mesh_;
    const std::vector<SurfacePlace>& places_;
    const std::vector<Vector3d>& positions_;
    const PointIndex& index_;
    const Anisotropy* anisotropy_;
    Unfolding unfolding_;
    Vector3d position_;  ///< The cell's position.
    Stretch stretch_;    ///< The stretch at the cell.
    std::vector<Neighbour> neighbours_;
    std::vector<double> lengths_;  ///< Lengths of the edges to the neighbours.
    ConvexRegion part_;
};

/// Concatenates the results of all threads. The results are then in the order of cells.
template <typename T>
std::vector<T> joined(std::vector<Found>& found, std::vector<T> Found::*part) {
    std::vector<T> all;
    std::size_t count = 0;
    for (const Found& one : found) count += (one.*part).size();
    all.reserve(count);
    for (Found& one : found) {
        all.insert(all.end(), (one.*part).begin(), (one.*part).end());
        std::vector<T>().swap(one.*part);
    }
    return all;
}

/// Divides each triangle among the cells that claim it. A triangle may have no claims if it is in a
/// dent that unfolding misses. Such a triangle goes to the cell with the largest claim to a
/// neighbouring triangle.
void share_areas(const SurfaceMesh& mesh, const std::vector<Claim>& claims, SurfaceCells& cells) {
    std::vector<double> claimed(mesh.triangles.size());
    std::vector<Claim> most(mesh.triangles.size());
    for (const Claim& claim : claims) {
        claimed[claim.triangle] += claim.area;
        if (claim.area > most[claim.triangle].area) most[claim.triangle] = claim;
    }
    for (const Claim& claim : claims) {
        cells.areas[claim.cell] += claim.area / claimed[claim.triangle] * mesh.area(claim.triangle);
    }
    std::vector<std::uint32_t> next;  // Triangles with an owner whose neighbours may have no owner.
    for (std::uint32_t t = 0; t < claimed.size(); ++t) {
        if (claimed[t] <= 0) continue;
        const auto& around = mesh.across[t];
        if (std::any_of(around.begin(), around.end(), [&](const TriangleEdge& other) {
                return other.exists() && claimed[other.triangle] <= 0;
            })) {
            next.push_back(t);
        }
    }
    for (std::size_t k = 0; k < next.size(); ++k) {
        for (const TriangleEdge& other : mesh.across[next[k]]) {
            if (!other.exists() || claimed[other.triangle] > 0) continue;
            claimed[other.triangle] = 1;
            most[other.triangle].cell = most[next[k]].cell;
            cells.areas[most[next[k]].cell] += mesh.area(other.triangle);
            next.push_back(other.triangle);
        }
    }
    for (std::size_t t = 0; t < claimed.size(); ++t) {
        if (claimed[t] <= 0) cells.bare_area += mesh.area(t);
    }
}

/// The entry of this neighbour in a list of edges sorted by neighbour; null if the list lacks the
/// neighbour.
const VoronoiEdge* edge_to(std::uint32_t neighbour, std::span<const VoronoiEdge> edges) {
    const auto found = std::lower_bound(edges.begin(), edges.end(), neighbour,
                                        [](const VoronoiEdge& edge, std::uint32_t number) {
                                            return edge.neighbour < number;
                                        });
    return found != edges.end() && found->neighbour == neighbour ? &*found : nullptr;
}

/// Averages the values that the two cells of each edge have found. An edge found by only one cell
/// gets half its length. Before the call, `cells` must have the edges as each cell has found them.
void match_edges(SurfaceCells& cells) {
    SurfaceCells matched;
    // Edges that the neighbour has found, but this cell has not.
    std::vector<std::pair<std::uint32_t, VoronoiEdge>> unseen;
    for (std::uint32_t cell = 0; cell < cells.ends.size(); ++cell) {
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            if (edge_to(cell, cells.edges_of(edge.neighbour))) continue;
            unseen.push_back({edge.neighbour, {cell, edge.length, edge.distance}});
        }
    }
    std::sort(unseen.begin(), unseen.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first, a.second.neighbour) < std::tie(b.first, b.second.neighbour);
    });
    matched.edges.reserve(cells.edges.size() + unseen.size());
    matched.ends.reserve(cells.ends.size());
    auto next = unseen.begin();
    for (std::uint32_t cell = 0; cell < cells.ends.size(); ++cell) {
        const auto take_unseen = [&](std::uint32_t before) {
            for (; next != unseen.end() && next->first == cell; ++next) {
                const VoronoiEdge& edge = next->second;
                if (edge.neighbour >= before) break;
                matched.edges.push_back({edge.neighbour, edge.length / 2, edge.distance});
            }
        };
        for (const VoronoiEdge& edge : cells.edges_of(cell)) {
            take_unseen(edge.neighbour);
            const VoronoiEdge* back = edge_to(cell, cells.edges_of(edge.neighbour));
            const VoronoiEdge other = back ? *back : VoronoiEdge{cell, 0, edge.distance};
            matched.edges.push_back({edge.neighbour, (edge.length + other.length) / 2,
                                     (edge.distance + other.distance) / 2});
        }
        take_unseen(static_cast<std::uint32_t>(cells.ends.size()));
        matched.ends.push_back(matched.edges.size());
    }
    cells.edges.swap(matched.edges);
    cells.ends.swap(matched.ends);
}

}  // namespace

SurfaceCells voronoi_cells(const SurfaceMesh& mesh, std::vector<SurfacePlace> places, Team& team,
                           const std::atomic<bool>& cancel, const Anisotropy* anisotropy) {
    SurfaceCells cells;
    cells.places = std::move(places);
    cells.areas.assign(cells.places.size(), 0);
    cells.ends.assign(cells.places.size(), 0);
    if (cells.places.empty() || cancel) return cells;
    std::vector<Vector3d> positions;
    positions.reserve(cells.places.size());
    for (const SurfacePlace& place : cells.places) positions.push_back(position_of(mesh, place));
    const double reach = repulsion_radius(mesh.total_area(), cells.places.size());
    const PointIndex index(positions, reach);
    const EdgeShapes shapes(mesh);
    std::vector<Found> found(static_cast<std::size_t>(team.size()));
    team.run([&](int thread) {
        const RowRange part =
            split_rows(static_cast<std::int64_t>(cells.places.size()), thread, team.size());
        RegionFinder finder(mesh, shapes, cells.places, positions, index, anisotropy);
        Found& own = found[static_cast<std::size_t>(thread)];
        for (std::int64_t k = part.begin; k < part.end && !cancel; ++k) {
            const auto cell = static_cast<std::size_t>(k);
            finder.find(static_cast<std::uint32_t>(cell), reach, own);
            cells.ends[cell] = own.edges.size();
        }
    });
    if (cancel) return cells;
    std::size_t before = 0;
    for (int thread = 0; thread < team.size(); ++thread) {
        const RowRange part =
            split_rows(static_cast<std::int64_t>(cells.places.size()), thread, team.size());
        for (std::int64_t k = part.begin; k < part.end; ++k) {
            cells.ends[static_cast<std::size_t>(k)] += before;
        }
        before += found[static_cast<std::size_t>(thread)].edges.size();
    }
    share_areas(mesh, joined(found, &Found::claims), cells);
    cells.edges = joined(found, &Found::edges);
    match_edges(cells);
    return cells;
}

}  // namespace cascade
