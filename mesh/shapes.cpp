// The sphere is an icosahedron whose sides are cut along great circles, the torus a lattice of
// angles, and the box six lattices. Each has texture coordinates.
#include "mesh/shapes.h"

#include "mesh/edge_pairs.h"
#include "mesh/lattice_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string_view>
#include <utility>

namespace cascade {

namespace {

constexpr double length_of_curve = 28.826;

Vector3d curve(double phi) {
    return {std::sin(phi) + 2 * std::sin(2 * phi), std::cos(phi) - 2 * std::cos(2 * phi),
            -std::sin(3 * phi)};
}

Vector3d tangent(double phi) {
    const Vector3d along{std::cos(phi) + 4 * std::cos(2 * phi),
                         4 * std::sin(2 * phi) - std::sin(phi), -3 * std::cos(3 * phi)};
    return along * (1 / length(along));
}

Vector3d reflected(Vector3d v, Vector3d across) {
    return v - across * (2 * dot(across, v) / dot(across, across));
}

/// Unit normals of the curve at n points, and at the first point again after a whole turn.
std::vector<Vector3d> normals_along(std::uint32_t n) {
    std::vector<Vector3d> normals{cross(tangent(0), Vector3d{0, 0, 1})};
    normals[0] = normals[0] * (1 / length(normals[0]));
    for (std::uint32_t i = 0; i < n; ++i) {
        const double here = tau * i / n, next = tau * (i + 1) / n;
        const Vector3d step = curve(next) - curve(here);
        const Vector3d along = reflected(tangent(here), step);
        normals.push_back(reflected(reflected(normals.back(), step), tangent(next) - along));
    }
    return normals;
}

Result<void> check_length(std::string_view name, double length) {
    if (length >= least_shape_length && length <= largest_shape_length) return {};
    return failure(fmt::format("{} {} is not a length that a surface can have", name, length));
}

Result<void> check_count(double triangles) {
    if (triangles <= most_shape_triangles) return {};
    return failure(fmt::format("the surface would have about {:.3g} triangles, but at most "
                               "{:.3g} are allowed",
                               triangles, most_shape_triangles),
                   "choose longer edges");
}

/// The number of edges into which a length is cut.
double cuts(double length, double edge, double least) {
    return std::max(least, std::round(length / edge));
}

/// Makes the points of an icosahedron whose edges and sides are cut into n parts.
class SphereMaker {
public:
    SphereMaker(double radius, std::uint32_t cuts) : radius_(radius), cuts_(cuts) {}

    SurfaceMesh make() {
        place_corners();
        // Makes the fans around the top and bottom poles, and the band between them.
        for (std::uint32_t k = 0; k < 5; ++k) {
            const std::uint32_t upper = 1 + k, next_upper = 1 + (k + 1) % 5;
            const std::uint32_t lower = 6 + k, next_lower = 6 + (k + 1) % 5;
            add_side(0, upper, next_upper);
            add_side(upper, lower, next_upper);
            add_side(next_upper, lower, next_lower);
            add_side(11, next_lower, lower);
        }
        SurfaceMesh mesh = mesh_of(std::move(points_), std::move(triangles_));
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            mesh.texture.push_back(places_of(mesh, t));
        }
        return mesh;
    }

private:
    void place_corners() {
        const double height = 1 / std::sqrt(5.0), out = 2 / std::sqrt(5.0);
        corners_.push_back({0, 1, 0});
        for (int k = 0; k < 10; ++k) {
            const double angle = tau * (k % 5 + (k < 5 ? 0 : 0.5)) / 5;
            corners_.push_back(
                {out * std::sin(angle), k < 5 ? height : -height, out * std::cos(angle)});
        }
        corners_.push_back({0, -1, 0});
        for (const Vector3d& corner : corners_) points_.push_back(corner * radius_);
    }

    /// Adds the weighted sum of three corners, scaled to the sphere. The weight of a corner is
    /// sin(angle · part / cuts_), where `angle` is the angle between two corners of the
    /// icosahedron. If only two corners have parts above 0, the point divides the arc between these
    /// corners in the ratio of the parts.
    std::uint32_t add_point(std::array<std::uint32_t, 3> corners,
                            std::array<std::uint32_t, 3> parts) {
        static const double angle = std::acos(1 / std::sqrt(5.0));
        Vector3d sum;
        for (std::size_t c = 0; c < 3; ++c) {
            sum = sum + corners_[corners[c]] * std::sin(angle * parts[c] / cuts_);
        }
        points_.push_back(unit(sum) * radius_);
        return static_cast<std::uint32_t>(points_.size() - 1);
    }

    /// Point `k` of an edge, counted from `from`. The two sides of the icosahedron at the edge
    /// share this point.
    std::uint32_t on_edge(std::uint32_t from, std::uint32_t to, std::uint32_t k) {
        if (k == 0) return from;
        if (k == cuts_) return to;
        if (from > to) return on_edge(to, from, cuts_ - k);
        const auto [found, is_new] =
            edges_.try_emplace({from, to}, static_cast<std::uint32_t>(points_.size()));
        for (std::uint32_t j = 1; is_new && j < cuts_; ++j)
            add_point({from, to, to}, {cuts_ - j, j, 0});
        return found->second + k - 1;
    }

    void add_side(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        std::vector<std::uint32_t> above = {a};
        for (std::uint32_t row = 1; row <= cuts_; ++row) {
            std::vector<std::uint32_t> below;
            for (std::uint32_t k = 0; k <= row; ++k) {
                if (k == 0) below.push_back(on_edge(a, b, row));
                else if (k == row) below.push_back(on_edge(a, c, row));
                else if (row == cuts_) below.push_back(on_edge(b, c, k));
                else below.push_back(add_point({a, b, c}, {cuts_ - row, row - k, k}));
            }
            for (std::uint32_t k = 0; k < row; ++k) {
                triangles_.push_back({above[k], below[k], below[k + 1]});
                if (k + 1 < row) triangles_.push_back({above[k], below[k + 1], above[k + 1]});
            }
            above.swap(below);
        }
    }

    /// The longitude and latitude of each corner, scaled to 0 … 1. Longitudes may exceed 1 at the
    /// seam.
    std::array<TexturePlace, 3> places_of(const SurfaceMesh& mesh, std::size_t t) const {
        const auto longitude = [](Vector3d p) { return 0.5 + std::atan2(p.x, p.z) / tau; };
        const double middle = longitude(mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2));
        std::array<double, 3> around{};
        std::array<TexturePlace, 3> places;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d p = mesh.corner(t, k);
            const bool is_pole = mesh.triangles[t][k] == 0 || mesh.triangles[t][k] == 11;
            around[k] = is_pole ? middle : longitude(p);
            places[k][1] = static_cast<float>(
                0.5 + std::asin(std::clamp(p.y / radius_, -1.0, 1.0)) / std::numbers::pi);
        }
        const double highest = std::max({around[0], around[1], around[2]});
        for (std::size_t k = 0; k < 3; ++k) {
            places[k][0] =
                static_cast<float>(around[k] < highest - 0.5 ? around[k] + 1 : around[k]);
        }
        return places;
    }

    double radius_;
    std::uint32_t cuts_;
    std::vector<Vector3d> corners_, points_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    /// The first of the points on each edge, by the edge's two corners.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges_;
};

/// Indices of a point in the lattice of a box.
using Step = std::array<std::uint32_t, 3>;

/// One side of a box. It begins at a corner and extends along two axes, whose cross product points
/// outwards.
struct BoxSide {
    Step corner;             ///< 0 for the low end, 1 for the high end of each axis.
    std::size_t across, up;  ///< The axes along which the side extends.
    bool is_backwards;       ///< `across` runs from the high to the low end.
    bool is_downwards;       ///< `up` runs from the high to the low end.
    /// The position in the net of the box: the number of depths and of widths to the left of the
    /// side, then the number of depths and of heights below it.
    std::array<int, 4> net;
};

// The axes are width (x), height (y) and depth (z).
constexpr std::array box_sides = {
    BoxSide{{0, 0, 0}, 2, 1, false, false, {0, 0, 1, 0}},  // Left.
    BoxSide{{0, 0, 1}, 0, 1, false, false, {1, 0, 1, 0}},  // Front.
    BoxSide{{1, 0, 1}, 2, 1, true, false, {1, 1, 1, 0}},   // Right.
    BoxSide{{1, 0, 0}, 0, 1, true, false, {2, 1, 1, 0}},   // Back.
    BoxSide{{0, 1, 1}, 0, 2, false, true, {1, 0, 1, 1}},   // Top.
    BoxSide{{0, 0, 0}, 0, 2, false, false, {1, 0, 0, 0}},  // Bottom.
};

class BoxMaker {
public:
    BoxMaker(const std::array<double, 3>& sides, const Step& counts)
        : sides_(sides), counts_(counts) {}

    SurfaceMesh make() {
        for (const BoxSide& side : box_sides) {
            for_points(side, [&](std::uint64_t key, double, double) { keys_.push_back(key); });
        }
        std::sort(keys_.begin(), keys_.end());
        keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
        std::vector<Vector3d> points;
        for (const std::uint64_t key : keys_) points.push_back(place_of(key));
        TriangleList list;
        for (const BoxSide& side : box_sides) {
            for_points(side, [&](std::uint64_t key, double u, double v) {
                const auto found = std::lower_bound(keys_.begin(), keys_.end(), key);
                list.add(static_cast<std::uint32_t>(found - keys_.begin()), u, v);
            });
        }
        return mesh_of(std::move(points), std::move(list));
    }

private:
    /// Calls `visit` for the corners of a side's triangles, with their keys and texture
    /// coordinates.
    template <typename Visit>
    void for_points(const BoxSide& side, const Visit& visit) const {
        const std::uint32_t columns = counts_[side.across], rows = counts_[side.up];
        const double left = side.net[0] * sides_[2] + side.net[1] * sides_[0];
        const double below = side.net[2] * sides_[2] + side.net[3] * sides_[1];
        const double scale = 1 / std::max(2 * (sides_[0] + sides_[2]), sides_[1] + 2 * sides_[2]);
        for (std::size_t j = 0; j < rows; ++j) {
            for (std::size_t i = 0; i < columns; ++i) {
                cut_rectangle(i, j, [&](std::size_t column, std::size_t row) {
                    Step step = {side.corner[0] * counts_[0], side.corner[1] * counts_[1],
                                 side.corner[2] * counts_[2]};
                    const auto along = static_cast<std::uint32_t>(column);
                    const auto up = static_cast<std::uint32_t>(row);
                    step[side.across] = side.is_backwards ? columns - along : along;
                    step[side.up] = side.is_downwards ? rows - up : up;
                    visit(key_of(step), scale * (left + sides_[side.across] * along / columns),
                          scale * (below + sides_[side.up] * up / rows));
                });
            }
        }
    }

    std::uint64_t key_of(const Step& step) const {
        return (std::uint64_t{step[0]} * (counts_[1] + 1) + step[1]) * (counts_[2] + 1) + step[2];
    }
    Vector3d place_of(std::uint64_t key) const {
        const auto coordinate = [&](std::size_t axis, std::uint64_t step) {
            return sides_[axis] * (static_cast<double>(step) / counts_[axis] - 0.5);
        };
        const std::uint64_t layer = key / (counts_[2] + 1);
        return {coordinate(0, layer / (counts_[1] + 1)), coordinate(1, layer % (counts_[1] + 1)),
                coordinate(2, key % (counts_[2] + 1))};
    }

    std::array<double, 3> sides_;
    Step counts_;
    std::vector<std::uint64_t> keys_;  ///< The keys of the points, in order.
};

}  // namespace

Result<SurfaceMesh> knot_mesh(double radius, double edge) {
    if (!(radius > 0 && radius < most_knot_radius)) {
        return failure(fmt::format("a tube of radius {} cannot be tied to the knot", radius),
                       fmt::format("the radius must be above 0 and below {}", most_knot_radius));
    }
    const double columns = std::round(length_of_curve / edge);
    const double rows = std::max(3.0, std::round(tau * radius / edge));
    if (!(edge > 0 && 2 * columns * rows <= most_shape_triangles)) {
        return failure(fmt::format("edges of length {} make too many triangles of the knot", edge),
                       "choose longer edges");
    }
    const auto n = static_cast<std::uint32_t>(std::max(24.0, columns));
    const std::vector<Vector3d> normals = normals_along(n);
    // The angle by which the last normal misses the first one.
    const Vector3d across = cross(tangent(0), normals[0]);
    const double missing = std::atan2(dot(normals[n], across), dot(normals[n], normals[0]));
    return ring_lattice(n, static_cast<std::uint32_t>(rows), [&](std::uint32_t i, std::uint32_t j) {
        const double phi = tau * i / n, angle = tau * j / rows + missing * i / n;
        const Vector3d side = cross(normals[i], tangent(phi));
        return curve(phi) + (normals[i] * std::cos(angle) + side * std::sin(angle)) * radius;
    });
}

Result<SurfaceMesh> sphere_mesh(double radius, double edge) {
    if (const auto fine = check_length("the radius", radius); !fine)
        return tl::unexpected(fine.error());
    if (const auto fine = check_length("the edge", edge); !fine)
        return tl::unexpected(fine.error());
    // 20 n² equilateral triangles with this edge have the area of the sphere.
    const double n = cuts(radius * std::sqrt(4 * std::numbers::pi / (5 * std::sqrt(3.0))), edge, 1);
    if (const auto fine = check_count(20 * n * n); !fine) return tl::unexpected(fine.error());
    return SphereMaker(radius, static_cast<std::uint32_t>(n)).make();
}

Result<SurfaceMesh> torus_mesh(double ring_radius, double tube_radius, double edge) {
    if (const auto fine = check_length("the ring's radius", ring_radius); !fine) {
        return tl::unexpected(fine.error());
    }
    if (const auto fine = check_length("the tube's radius", tube_radius); !fine) {
        return tl::unexpected(fine.error());
    }
    if (const auto fine = check_length("the edge", edge); !fine)
        return tl::unexpected(fine.error());
    if (tube_radius >= ring_radius) {
        return failure(
            fmt::format("a tube of radius {} bent to a ring of radius {} would cross "
                        "itself",
                        tube_radius, ring_radius));
    }
    const double columns = cuts(tau * ring_radius, edge, 3),
                 rows = cuts(tau * tube_radius, edge, 3);
    if (const auto fine = check_count(2 * columns * rows); !fine)
        return tl::unexpected(fine.error());
    return ring_lattice(static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows),
                        [&](std::uint32_t i, std::uint32_t j) {
                            const double around = tau * i / columns, tube = tau * j / rows;
                            const double out = ring_radius - tube_radius * std::cos(tube);
                            return Vector3d{-out * std::sin(around), -tube_radius * std::sin(tube),
                                            -out * std::cos(around)};
                        });
}

Result<SurfaceMesh> box_mesh(Vector3d sides, double edge) {
    if (const auto fine = check_length("the edge", edge); !fine)
        return tl::unexpected(fine.error());
    const std::array<double, 3> lengths = {sides.x, sides.y, sides.z};
    std::array<double, 3> n{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (const auto fine = check_length("the side", lengths[axis]); !fine) {
            return tl::unexpected(fine.error());
        }
        n[axis] = cuts(lengths[axis], edge, 1);
    }
    const double triangles = 4 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]);
    if (const auto fine = check_count(triangles); !fine) return tl::unexpected(fine.error());
    return BoxMaker(lengths, {static_cast<std::uint32_t>(n[0]), static_cast<std::uint32_t>(n[1]),
                              static_cast<std::uint32_t>(n[2])})
        .make();
}

}  // namespace cascade
