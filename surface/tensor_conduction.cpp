// Adds up the energy of each corner of each triangle as squares of differences over the three links
// of the triangle: (p d₁ + q d₂)² = p (p + q) d₁² + q (p + q) d₂² − p q (d₁ − d₂)².
#include "surface/tensor_conduction.h"

#include "core/check.h"
#include "surface/cell_gradient.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {

namespace {

/// The squares of which a corner's energy consists, and their factors.
struct Squares {
    double first = 0, second = 0, across = 0;
};
Squares squares(double pp, double pq, double qq) { return {pp + pq, qq + pq, -pq}; }

}  // namespace

TensorConduction::TensorConduction(const SurfaceMesh& mesh, const SurfaceCells& cells,
                                   const CellFrames& frames, const Conduction& conduction,
                                   Team& team, const std::atomic<bool>& cancel)
    : links_(cells), areas_(conduction.areas) {
    std::vector<Vector3d> unfolded = unfolded_neighbours(mesh, cells, team, cancel);
    const CellTriangles found = triangles_between(mesh, cells, frames, unfolded);
    if (!found.diagonals.empty()) {
        add_diagonals(mesh, found);
        unfolded = unfolded_neighbours(mesh, links_, team, cancel);
    }
    number_pairs(conduction);
    for (const CellTriangle& triangle : found.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t before = triangle[(k + 2) % 3], cell = triangle[k],
                                after = triangle[(k + 1) % 3];
            const std::size_t first = link_between(cell, before),
                              second = link_between(cell, after);
            const auto in_plane = [&](std::size_t link) {
                return Vector2d{dot(frames.right[cell], unfolded[link]),
                                dot(frames.down[cell], unfolded[link])};
            };
            add_corner(cell, first, second, link_between(before, after), in_plane(first),
                       in_plane(second));
        }
    }
    limit();
}

/// Adds a link without flow for each diagonal. The distance of such a link is measured in space.
void TensorConduction::add_diagonals(const SurfaceMesh& mesh, const CellTriangles& found) {
    std::vector<std::vector<std::uint32_t>> added(links_.places.size());
    for (const auto& [one, other] : found.diagonals) {
        added[one].push_back(other);
        added[other].push_back(one);
    }
    SurfaceCells all = links_;
    all.edges.clear();
    for (std::size_t cell = 0; cell < added.size(); ++cell) {
        const auto edges = links_.edges_of(cell);
        all.edges.insert(all.edges.end(), edges.begin(), edges.end());
        const Vector3d here = position_of(mesh, links_.places[cell]);
        for (const std::uint32_t other : added[cell]) {
            const double distance = length(position_of(mesh, links_.places[other]) - here);
            all.edges.push_back({other, 0, distance});
        }
        all.ends[cell] = all.edges.size();
    }
    links_ = std::move(all);
}

void TensorConduction::number_pairs(const Conduction& conduction) {
    pairs_.resize(links_.edges.size());
    std::size_t edge = 0;  // An index into `conduction.flows`, which leaves out diagonals.
    for (std::size_t cell = 0, link = 0; cell < areas_.size(); ++cell) {
        for (; link < links_.ends[cell]; ++link) {
            const VoronoiEdge& to = links_.edges[link];
            const double flow = to.length > 0 ? conduction.flows[edge++] : 0;
            if (to.neighbour > cell) {
                pairs_[link] = static_cast<std::uint32_t>(flows_.size());
                flows_.push_back(flow);
            } else {
                pairs_[link] = pairs_[link_between(to.neighbour, static_cast<std::uint32_t>(cell))];
            }
        }
    }
}

std::size_t TensorConduction::link_between(std::uint32_t from, std::uint32_t to) const {
    const auto links = links_.edges_of(from);
    const auto found = std::find_if(links.begin(), links.end(),
                                    [&](const VoronoiEdge& link) { return link.neighbour == to; });
    CHECK(found != links.end(), "the cells of a triangle are linked");
    return static_cast<std::size_t>(&*found - links_.edges.data());
}

/// Adds the corner of a triangle at `cell`, between the directions to the previous and the next
/// cell. Corners that unfold with the wrong orientation are left out.
void TensorConduction::add_corner(std::uint32_t cell, std::size_t before, std::size_t after,
                                  std::size_t across, Vector2d previous, Vector2d next) {
    const double twice_area = cross(previous, next);
    if (!(twice_area > 1e-9 * length(previous) * length(next))) return;
    // The gradient is (d₁ (y₂, −x₂) + d₂ (−y₁, x₁)) / (2 S), and S / 3 is the area of the corner.
    const double scale = std::sqrt(twice_area / 6) / twice_area;
    corners_.push_back({cell, pairs_[before], pairs_[after], pairs_[across],
                        Vector2d{next.y, -next.x} * scale,
                        Vector2d{-previous.y, previous.x} * scale});
}

void TensorConduction::limit() {
    std::vector<std::array<std::uint32_t, 2>> ends(flows_.size());
    std::vector<double> sums(areas_.size(), 0), added(areas_.size(), 0);
    for (std::size_t cell = 0, link = 0; cell < areas_.size(); ++cell) {
        for (; link < links_.ends[cell]; ++link) {
            const std::uint32_t other = links_.edges[link].neighbour;
            sums[cell] += flows_[pairs_[link]];
            if (other > cell) ends[pairs_[link]] = {static_cast<std::uint32_t>(cell), other};
        }
    }
    const auto for_each_cell = [&](const Corner& corner, const auto& use) {
        const Squares all =
            squares(dot(corner.a, corner.a), dot(corner.a, corner.b), dot(corner.b, corner.b));
        for (const auto& [pair, size] :
             {std::pair(corner.first, all.first), std::pair(corner.second, all.second),
              std::pair(corner.across, all.across)}) {
            for (const std::uint32_t cell : ends[pair]) use(cell, std::abs(size));
        }
    };
    for (const Corner& corner : corners_) {
        for_each_cell(corner, [&](std::uint32_t cell, double size) { added[cell] += size; });
    }
    double most = 0;
    for (std::size_t cell = 0; cell < areas_.size(); ++cell) {
        if (areas_[cell] > 0) most = std::max(most, sums[cell] / areas_[cell]);
    }
    for (Corner& corner : corners_) {
        double part = 1;
        for_each_cell(corner, [&](std::uint32_t cell, double) {
            const double limit = most * areas_[cell];
            if (added[cell] > limit) part = std::min(part, limit / added[cell]);
        });
        corner.a = corner.a * std::sqrt(part);
        corner.b = corner.b * std::sqrt(part);
    }
}

std::vector<double> TensorConduction::isotropic() const {
    return weights(std::vector<double>(areas_.size(), 1), std::vector<Vector2d>(areas_.size()));
}

std::vector<double> TensorConduction::weights(std::span<const double> low,
                                              std::span<const Vector2d> along) const {
    std::vector<double> of_pairs(flows_.size(), 0);
    for (const Corner& corner : corners_) {
        const Vector2d v = along[corner.cell];
        const double p = dot(v, corner.a), q = dot(v, corner.b);
        const Squares add = squares(p * p, p * q, q * q);
        of_pairs[corner.first] += add.first;
        of_pairs[corner.second] += add.second;
        of_pairs[corner.across] += add.across;
    }
    std::vector<double> weights;
    weights.reserve(links_.edges.size());
    for (std::size_t cell = 0, link = 0; cell < areas_.size(); ++cell) {
        for (; link < links_.ends[cell]; ++link) {
            const double rate = (low[cell] + low[links_.edges[link].neighbour]) / 2;
            const double flow = flows_[pairs_[link]] * rate + of_pairs[pairs_[link]];
            weights.push_back(areas_[cell] > 0 ? flow / areas_[cell] : 0);
        }
    }
    return weights;
}

}  // namespace cascade
