// Walks around the faces of the graph whose edges are the Voronoi edges. The edges around a cell
// are sorted by direction.
#include "surface/cell_triangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cascade {

namespace {

constexpr std::size_t most_corners = 64;

/// A cell counts as surrounded by others if the sum of its Voronoi edges' normals, times the edges'
/// lengths, is shorter than this fraction of its circumference. At a boundary of the surface the
/// sum is as long as the missing edge.
constexpr double most_open = 0.15;

constexpr std::size_t no_edge = static_cast<std::size_t>(-1);

class FaceWalker {
public:
    FaceWalker(const SurfaceMesh& mesh, const SurfaceCells& cells, const CellFrames& frames,
               std::span<const Vector3d> unfolded)
        : cells_(cells) {
        has_boundary_ = std::any_of(mesh.across.begin(), mesh.across.end(), [](const auto& edges) {
            return std::any_of(edges.begin(), edges.end(),
                               [](const TriangleEdge& edge) { return !edge.exists(); });
        });
        for (std::size_t cell = 0, edge = 0; cell < cells.places.size(); ++cell) {
            for (; edge < cells.ends[cell]; ++edge) {
                from_.push_back(static_cast<std::uint32_t>(cell));
                flat_.push_back({dot(frames.right[cell], unfolded[edge]),
                                 dot(frames.down[cell], unfolded[edge])});
            }
        }
        sort_around_cells();
    }

    CellTriangles find() {
        std::vector<bool> seen(flat_.size(), false);
        std::vector<std::size_t> walk;  // For each corner, the edge to the previous corner.
        for (std::size_t first = 0; first < flat_.size(); ++first) {
            walk.clear();
            std::size_t edge = first;
            while (edge != no_edge && !seen[edge]) {
                seen[edge] = true;
                walk.push_back(edge);
                edge = reverse_of(after_[edge]);
            }
            if (edge == first && is_polygon(walk)) cut(walk);
        }
        auto& diagonals = found_.diagonals;
        std::sort(diagonals.begin(), diagonals.end());
        diagonals.erase(std::unique(diagonals.begin(), diagonals.end()), diagonals.end());
        return std::move(found_);
    }

private:
    std::size_t first_edge(std::size_t cell) const { return cell == 0 ? 0 : cells_.ends[cell - 1]; }

    void sort_around_cells() {
        after_.resize(flat_.size());
        std::vector<std::pair<double, std::size_t>> around;
        for (std::size_t cell = 0; cell < cells_.places.size(); ++cell) {
            around.clear();
            for (std::size_t edge = first_edge(cell); edge < cells_.ends[cell]; ++edge)
                around.emplace_back(std::atan2(flat_[edge].y, flat_[edge].x), edge);
            std::sort(around.begin(), around.end());
            for (std::size_t k = 0; k < around.size(); ++k)
                after_[around[k].second] = around[(k + 1) % around.size()].second;
        }
    }

    /// The index of the edge from one cell to another; no_edge if the cells share none.
    std::size_t edge_between(std::uint32_t from, std::uint32_t to) const {
        const auto edges = cells_.edges_of(from);
        const auto found = std::find_if(edges.begin(), edges.end(), [&](const VoronoiEdge& edge) {
            return edge.neighbour == to;
        });
        if (found == edges.end()) return no_edge;
        return first_edge(from) + static_cast<std::size_t>(found - edges.begin());
    }
    std::size_t reverse_of(std::size_t edge) const {
        return edge_between(cells_.edges[edge].neighbour, from_[edge]);
    }

    bool is_surrounded(std::uint32_t cell) const {
        Vector2d sum;
        double around = 0;
        for (std::size_t edge = first_edge(cell); edge < cells_.ends[cell]; ++edge) {
            const double size = cells_.edges[edge].length;
            sum = sum + unit_of(flat_[edge]) * size;
            around += size;
        }
        return length(sum) < most_open * around;
    }

    /// Whether a walk goes around a convex polygon whose corners are different cells. A triangle is
    /// such a polygon. The polygon must be a part of the surface, not a hole.
    bool is_polygon(const std::vector<std::size_t>& walk) const {
        if (walk.size() < 3 || walk.size() > most_corners) return false;
        std::vector<std::uint32_t> corners;
        for (const std::size_t edge : walk) corners.push_back(from_[edge]);
        std::sort(corners.begin(), corners.end());
        if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) return false;
        const bool is_convex = std::all_of(walk.begin(), walk.end(), [&](std::size_t edge) {
            return cross(flat_[edge], flat_[after_[edge]]) > 0;
        });
        if (walk.size() == 3 || !is_convex) return is_convex;
        return !has_boundary_ || std::any_of(corners.begin(), corners.end(),
                                             [&](auto cell) { return is_surrounded(cell); });
    }

    /// Adds the triangles of a polygon. The triangles lie in a strip, so that each corner has few
    /// diagonals.
    void cut(const std::vector<std::size_t>& walk) {
        std::vector<std::uint32_t> corners;
        for (const std::size_t edge : walk) corners.push_back(from_[edge]);
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
                    corners.end());
        std::size_t low = 0, high = corners.size() - 1;
        while (high - low > 1) {
            add(corners[low], corners[low + 1], corners[high]);
            if (high - ++low < 2) break;
            add(corners[low], corners[high - 1], corners[high]);
            --high;
        }
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        found_.triangles.push_back({a, b, c});
        for (const auto& [one, other] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            if (edge_between(one, other) == no_edge)
                found_.diagonals.push_back(std::minmax(one, other));
        }
    }

    const SurfaceCells& cells_;
    bool has_boundary_ = false;
    std::vector<std::uint32_t> from_;  ///< The cell of each edge.
    std::vector<Vector2d> flat_;       ///< The neighbour across each edge, in the cell's frame.
    std::vector<std::size_t> after_;   ///< The next edge around the cell.
    CellTriangles found_;
};

}  // namespace

CellTriangles triangles_between(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                const CellFrames& frames, std::span<const Vector3d> unfolded) {
    return FaceWalker(mesh, cells, frames, unfolded).find();
}

}  // namespace cascade
