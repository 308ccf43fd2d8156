// Each triangle is divided into boxes. A box has a list of the images of all cells that are within
// the radius of some position in the box.
#include "surface/cell_filter.h"

#include "core/enough_memory.h"
#include "mesh/triangle_mesh.h"
#include "surface/point_index.h"
#include "surface/relax.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace cascade {

namespace {

/// If the sum of weights is below this, the position is almost out of reach of all cells, and no
/// average is taken.
constexpr float least_sum = 1e-5F;

/// The largest number of boxes. More boxes would need more memory than machines have.
constexpr std::size_t most_boxes = 0xffffffff;

/// Images of one cell that are nearer to each other than this, in radii, are merged.
constexpr float same_point_distance = 0.004F;

/// The weight at a distance whose square in radii is `square`.
float weight_of(float square) { return std::max(0.0F, 1 + square * (2 * std::sqrt(square) - 3)); }

/// For each of `others`, the nearest of `points` in space.
std::vector<std::uint32_t> nearest_points(std::span<const Vector3d> points,
                                          std::span<const Vector3d> others, double reach) {
    std::vector<std::uint32_t> nearest(others.size(), TriangleEdge::none);
    for (std::size_t left = others.size(); left > 0; reach *= 2) {
        const PointIndex index(points, reach);
        for (std::size_t k = 0; k < others.size(); ++k) {
            if (nearest[k] != TriangleEdge::none) continue;
            double least = 0;
            index.near(others[k], reach, [&](std::uint32_t point, double square) {
                const bool is_first = nearest[k] == TriangleEdge::none;
                if (!is_first && (square > least || (square == least && point > nearest[k])))
                    return;
                least = square;
                nearest[k] = point;
            });
            if (nearest[k] != TriangleEdge::none) --left;
        }
    }
    return nearest;
}

}  // namespace

CellFilter::CellFilter(const SurfaceMesh& mesh, const SurfaceCells& cells, Team& team)
    : radius_(repulsion_radius(mesh.total_area(), cells.places.size())) {
    const std::vector<FlatTriangle> frames = longest_edge_frames(mesh);
    lay_out(mesh, cells, frames);
    fill_boxes(mesh, cells, frames, team);
    find_substitutes(mesh, cells);
}

void CellFilter::lay_out(const SurfaceMesh& mesh, const SurfaceCells& cells,
                         std::span<const FlatTriangle> frames) {
    const Vector3d middle = position_of(mesh, cells.places[0]);
    positions_.reserve(cells.places.size());
    for (const SurfacePlace& place : cells.places) {
        positions_.push_back(single((position_of(mesh, place) - middle) * (1 / radius_)));
    }
    patches_.resize(mesh.triangles.size());
    std::size_t boxes = 0;
    for (std::uint32_t t = 0; t < patches_.size(); ++t) {
        Patch& patch = patches_[t];
        const std::uint32_t first = longest_edge(mesh, t), second = (first + 1) % 3;
        const FlatTriangle& flat = frames[t];
        const Vector2d third = flat[(first + 2) % 3];
        const Vector3d along = unit(mesh.corner(t, second) - mesh.corner(t, first));
        patch.origin = single((mesh.corner(t, first) - middle) * (1 / radius_));
        patch.x_axis = single(along);
        patch.y_axis = single(cross(unit(mesh.double_area_normal(t)), along));
        const double scale = 1 / radius_;
        patch.second_x = static_cast<float>(flat[second].x * scale);
        patch.third_x = static_cast<float>(third.x * scale);
        patch.third_y = static_cast<float>(third.y * scale);
        patch.first_corner = first;
        const auto boxes_along = [](float size) {
            return static_cast<std::uint32_t>(std::clamp(std::ceil(size), 1.0F, 65536.0F));
        };
        patch.columns = boxes_along(patch.second_x);
        patch.rows = boxes_along(patch.third_y);
        patch.first_box = static_cast<std::uint32_t>(boxes);
        boxes += std::size_t{patch.columns} * patch.rows;
        if (boxes > most_boxes) lack_memory();
    }
    box_ends_.assign(boxes, 0);
}

CellFilter::FlatPoint CellFilter::flat_point(const Patch& patch, const SurfacePlace& place) {
    const auto second = static_cast<float>(place.weights[(patch.first_corner + 1) % 3]);
    const auto third = static_cast<float>(place.weights[(patch.first_corner + 2) % 3]);
    FlatPoint result{second * patch.second_x + third * patch.third_x, third * patch.third_y, {}};
    // On an edge, the opposite corner has weight 0. So only the sightings seen from this edge
    // count.
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double others = place.weights[k] * place.weights[(k + 1) % 3];
        result.edges[k] = static_cast<float>(others * others);
        sum += result.edges[k];
    }
    if (sum > 0) {
        for (float& edge : result.edges) edge /= sum;
    } else {
        // At a corner the two adjacent edges count equally.
        for (std::size_t k = 0; k < 3; ++k) {
            result.edges[k] = place.weights[k] + place.weights[(k + 1) % 3] > 0.5 ? 0.5F : 0.0F;
        }
    }
    return result;
}

std::uint32_t CellFilter::box_of(const Patch& patch, FlatPoint place) {
    const auto number = [](float at, std::uint32_t count) {
        return static_cast<std::uint32_t>(std::clamp(at, 0.0F, static_cast<float>(count - 1)));
    };
    return patch.first_box + number(place.y, patch.rows) * patch.columns +
           number(place.x, patch.columns);
}

std::span<const CellFilter::Sighting> CellFilter::sightings_of(std::uint32_t first_box,
                                                               std::uint32_t boxes) const {
    const std::size_t first = first_box == 0 ? 0 : box_ends_[first_box - 1];
    return {sightings_.data() + first, box_ends_[first_box + boxes - 1] - first};
}

/// The sightings of an image. Edges that see the image at nearly the same point share a sighting.
CellFilter::Sightings CellFilter::sightings_in(const CellImage& image, std::uint32_t cell) {
    Sightings found;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [x, y] = image.from_edges[k];
        const std::uint32_t bit = 1u << k;
        bool is_shared = false;
        for (std::size_t j = 0; j < found.count && !is_shared; ++j) {
            Sighting& other = found.all[j];
            const float dx = x - other.x, dy = y - other.y;
            is_shared = dx * dx + dy * dy < same_point_distance * same_point_distance;
            if (is_shared) other.edges |= bit;
        }
        if (!is_shared) found.all[found.count++] = {cell, bit, x, y};
    }
    return found;
}

/// Calls `visit(box)` for all boxes of the image's triangle that are within the radius of the
/// image. These boxes form a rectangle.
template <typename Visit>
void CellFilter::visit_boxes(const CellImage& image, const Visit& visit) const {
    const Patch& patch = patches_[image.triangle];
    if (patch.columns == 1 && patch.rows == 1) return visit(patch.first_box);
    // Slightly more than the radius, because rounding decides to which box a position on a boundary
    // belongs.
    const float reach = 1 + 1e-3F;
    const auto number = [](float at, std::uint32_t count) {
        return static_cast<std::uint32_t>(
            std::clamp(std::floor(at), 0.0F, static_cast<float>(count - 1)));
    };
    const auto& [a, b, c] = image.from_edges;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [bottom, top] = std::minmax({a.y, b.y, c.y});
    const std::uint32_t last_row = number(top + reach, patch.rows);
    const std::uint32_t last_column = number(right + reach, patch.columns);
    for (std::uint32_t row = number(bottom - reach, patch.rows); row <= last_row; ++row) {
        for (std::uint32_t column = number(left - reach, patch.columns); column <= last_column;
             ++column) {
            visit(patch.first_box + row * patch.columns + column);
        }
    }
}

void CellFilter::fill_boxes(const SurfaceMesh& mesh, const SurfaceCells& cells,
                            std::span<const FlatTriangle> frames, Team& team) {
    struct Found {
        std::uint32_t box = 0;
        Sighting sighting;
    };
    std::vector<std::deque<Found>> parts(static_cast<std::size_t>(team.size()));
    team.run([&](int thread) {
        const RowRange part =
            split_rows(static_cast<std::int64_t>(cells.places.size()), thread, team.size());
        ImageFinder finder(mesh, frames, radius_);
        std::deque<Found>& found = parts[static_cast<std::size_t>(thread)];
        for (std::int64_t k = part.begin; k < part.end; ++k) {
            const auto cell = static_cast<std::uint32_t>(k);
            for (const CellImage& image : finder.find(cells.places[cell])) {
                const Sightings seen = sightings_in(image, cell);
                visit_boxes(image, [&](std::uint32_t box) {
                    for (std::size_t j = 0; j < seen.count; ++j)
                        found.push_back({box, seen.all[j]});
                });
            }
        }
    });
    for (const std::deque<Found>& part : parts) {
        for (const Found& found : part) ++box_ends_[found.box];
    }
    std::size_t sum = 0;
    for (std::size_t& end : box_ends_) {
        const std::size_t count = end;
        // The start of the list for now. While the list is filled, this number grows to the list's
        // end.
        end = sum;
        sum += count;
    }
    sightings_.resize(sum);
    for (std::deque<Found>& part : parts) {
        for (const Found& found : part) sightings_[box_ends_[found.box]++] = found.sighting;
        std::deque<Found>().swap(part);
    }
}

/// Chooses the cell to use in triangles without sightings: the cell of the next triangle on the way
/// to the nearest cell. For a component without cells, chooses the cell nearest in space to the
/// component's first triangle.
void CellFilter::find_substitutes(const SurfaceMesh& mesh, const SurfaceCells& cells) {
    std::vector<std::uint32_t> waiting;
    std::vector<bool> is_found(patches_.size());
    for (std::uint32_t t = 0; t < patches_.size(); ++t) {
        const Patch& patch = patches_[t];
        is_found[t] = !sightings_of(patch.first_box, patch.columns * patch.rows).empty();
        if (is_found[t]) waiting.push_back(t);
    }
    if (waiting.size() == patches_.size()) return;
    for (const std::uint32_t t : waiting) {
        const FlatPoint middle = flat_point(patches_[t], {t, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        patches_[t].otherwise = nearest_cell(patches_[t], middle);
    }
    const auto spread = [&] {
        for (std::size_t k = 0; k < waiting.size(); ++k) {
            for (const TriangleEdge& other : mesh.across[waiting[k]]) {
                if (!other.exists() || is_found[other.triangle]) continue;
                patches_[other.triangle].otherwise = patches_[waiting[k]].otherwise;
                is_found[other.triangle] = true;
                waiting.push_back(other.triangle);
            }
        }
        waiting.clear();
    };
    spread();
    const std::vector<std::uint32_t> components = connected_components(mesh);
    std::vector<std::uint32_t> bare;  // The first triangles of components without cells.
    std::vector<Vector3d> positions, bare_positions;
    std::uint32_t seen = 0;
    for (std::uint32_t t = 0; t < patches_.size(); ++t) {
        const bool is_first = components[t] == seen;
        seen += is_first;
        if (!is_first || is_found[t]) continue;
        bare.push_back(t);
        bare_positions.push_back(position_of(mesh, {t, {1.0 / 3, 1.0 / 3, 1.0 / 3}}));
    }
    for (const SurfacePlace& place : cells.places) positions.push_back(position_of(mesh, place));
    const std::vector<std::uint32_t> nearest = nearest_points(positions, bare_positions, radius_);
    for (std::size_t k = 0; k < bare.size(); ++k) {
        patches_[bare[k]].otherwise = nearest[k];
        is_found[bare[k]] = true;
        waiting.push_back(bare[k]);
    }
    spread();
}

/// The nearest of all cells that have sightings in the triangle, at any distance.
std::uint32_t CellFilter::nearest_cell(const Patch& patch, FlatPoint place) const {
    std::uint32_t nearest = patch.otherwise;
    float least = INFINITY;
    for (const Sighting& sighting : sightings_of(patch.first_box, patch.columns * patch.rows)) {
        const float x = place.x - sighting.x, y = place.y - sighting.y;
        const float square = x * x + y * y;
        if (square > least || (square == least && sighting.cell > nearest)) continue;
        least = square;
        nearest = sighting.cell;
    }
    return nearest;
}

/// Calls `visit(near)` once for each cell within the radius. On an edge, visit() gets the distance
/// that is stored for the edge itself, so that both triangles agree. Inside a triangle, distances
/// are interpolated between the edges.
template <typename Visit>
void CellFilter::visit_near(const Patch& patch, FlatPoint place, const Visit& visit) const {
    const Vector3 position = patch.origin + patch.x_axis * place.x + patch.y_axis * place.y;
    const auto [a, b, c] = place.edges;
    // A table with the sum of the weights of each subset of the edges. A branch for each subset
    // would be unpredictable.
    const std::array<float, 8> parts{0, a, b, a + b, c, a + c, b + c, 1};
    const auto sightings = sightings_of(box_of(patch, place), 1);
    for (std::size_t k = 0; k < sightings.size();) {
        Near near{sightings[k].cell, 0, 0, 0};
        for (; k < sightings.size() && sightings[k].cell == near.cell; ++k) {
            const Sighting& sighting = sightings[k];
            const float part = parts[sighting.edges];
            const float x = place.x - sighting.x, y = place.y - sighting.y;
            near.square += part * (x * x + y * y);
            near.x += part * x;
            near.y += part * y;
        }
        if (near.square >= 1) continue;
        const Vector3 apart = position - positions_[near.cell];
        if (const float in_space = dot(apart, apart); in_space > near.square) {
            near = {near.cell, in_space, dot(apart, patch.x_axis), dot(apart, patch.y_axis)};
        }
        if (near.square < 1) visit(near);
    }
}

void CellFilter::shares(const SurfacePlace& place, std::vector<CellShare>& out) const {
    const Patch& patch = patches_[place.triangle];
    const FlatPoint at = flat_point(patch, place);
    out.clear();
    float sum = 0;
    visit_near(patch, at, [&](const Near& near) {
        const float weight = weight_of(near.square);
        out.push_back({near.cell, weight});
        sum += weight;
    });
    if (sum < least_sum) {
        out.assign(1, {nearest_cell(patch, at), 1});
        return;
    }
    const float scale = 1 / sum;
    for (CellShare& share : out) share.weight *= scale;
}

void CellFilter::sloped_shares(const SurfacePlace& place, std::vector<SlopedShare>& out) const {
    const Patch& patch = patches_[place.triangle];
    const FlatPoint at = flat_point(patch, place);
    out.clear();
    float sum = 0;
    Vector3 slope;
    visit_near(patch, at, [&](const Near& near) {
        const float weight = weight_of(near.square);
        // The derivative of the weight by d². It is multiplied below by the derivative of d² by the
        // position.
        const float steep = 6 * (std::sqrt(near.square) - 1);
        out.push_back(
            {near.cell, weight, patch.x_axis * (steep * near.x) + patch.y_axis * (steep * near.y)});
        sum += weight;
        slope = slope + out.back().slope;
    });
    if (sum < least_sum) {
        out.assign(1, {nearest_cell(patch, at), 1, {}});
        return;
    }
    const float scale = 1 / sum;
    for (SlopedShare& share : out) {
        share.weight *= scale;
        share.slope = (share.slope - slope * share.weight) * scale;
    }
}

}  // namespace cascade
