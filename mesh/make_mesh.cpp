// Repairs in this order: merges points, triangulates polygons, removes duplicates, pairs and
// orients triangles, separates fans, removes flat triangles.
#include "mesh/make_mesh.h"

#include "core/counted.h"
#include "mesh/edge_pairs.h"
#include "mesh/flat_triangles.h"
#include "mesh/point_table.h"
#include "mesh/separate_fans.h"
#include "mesh/sort_by_point.h"
#include "mesh/triangulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

namespace {

constexpr double least_size = 1e-70, largest_size = 1e70;

class MeshMaker {
public:
    explicit MeshMaker(PolygonSoup soup) : soup_(std::move(soup)) {}

    Result<MadeMesh> make() {
        if (Result<void> fine = check_points(); !fine) return tl::unexpected(fine.error());
        join_points();
        if (Result<void> fine = cut_polygons(); !fine) return tl::unexpected(fine.error());
        leave_out_doubles();
        pair_and_orient();
        split_fans();
        if (Result<void> fine = remove_flat(); !fine) return tl::unexpected(fine.error());
        if (mesh().total_area() <= 0) return failure("the model's faces have no area");
        return std::move(made_);
    }

private:
    SurfaceMesh& mesh() { return made_.mesh; }
    void say(std::string sentence) { made_.repairs.push_back(std::move(sentence)); }

    Result<void> check_points() {
        if (soup_.corners.size() >= TriangleEdge::none) {
            return failure("the model has more corners than can be numbered");
        }
        std::vector<bool> is_used(soup_.points.size());
        for (const std::uint32_t corner : soup_.corners) is_used[corner] = true;
        double size = 0;
        for (std::size_t k = 0; k < soup_.points.size(); ++k) {
            if (!is_used[k]) continue;
            Vector3d& p = soup_.points[k];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                return failure(
                    fmt::format("point {} of the model, counted from 0, has the position "
                                "({}, {}, {})",
                                k, p.x, p.y, p.z));
            }
            p = p + Vector3d{0, 0, 0};  // −0 becomes 0.
            size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        }
        if (size != 0 && !(size >= least_size && size <= largest_size)) {
            return failure(
                fmt::format("the model's coordinates of up to {:.3g} are too {} to compute "
                            "with",
                            size, size > 1 ? "large" : "small"));
        }
        const auto unused =
            static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), false));
        if (unused > 0) {
            say(counted(unused, "point that no face uses was", "points that no face uses were") +
                " left out");
        }
        is_used_ = std::move(is_used);
        return {};
    }

    /// Replaces points at the same position by the first of them.
    void join_points() {
        joined_.resize(soup_.points.size());
        PointTable places(soup_.points);
        std::size_t count = 0;
        for (std::uint32_t k = 0; k < soup_.points.size(); ++k) {
            if (!is_used_[k]) continue;
            joined_[k] = places.find_or_add(k);
            count += joined_[k] != k;
        }
        if (count > 0) {
            say(counted(count, "point was", "points were") +
                " joined with others in the same place");
        }
    }

    std::uint32_t point_of(std::uint32_t corner) const { return joined_[soup_.corners[corner]]; }

    Result<void> cut_polygons() {
        std::size_t without_area = 0;
        std::vector<Vector3d> places;
        std::vector<std::array<std::uint32_t, 3>> pieces;
        for (std::size_t p = 0; p < soup_.polygon_count(); ++p) {
            places.clear();
            pieces.clear();
            for (const std::uint32_t point : soup_.polygon(p))
                places.push_back(soup_.points[point]);
            if (!triangulate(places, pieces)) {
                return failure(
                    fmt::format("face {} of the model, counted from 0, has {} corners "
                                "and too many dents to be cut into triangles",
                                p, places.size()));
            }
            if (places.size() < 3) ++without_area;
            const auto first = static_cast<std::uint32_t>(soup_.first_corner(p));
            for (const auto& piece : pieces) {
                const std::array<std::uint32_t, 3> corners = {first + piece[0], first + piece[1],
                                                              first + piece[2]};
                const std::uint32_t a = point_of(corners[0]), b = point_of(corners[1]),
                                    c = point_of(corners[2]);
                if (a == b || b == c || c == a) {
                    ++without_area;
                } else {
                    corners_.push_back(corners);
                    mesh().faces.push_back(static_cast<std::uint32_t>(p));
                }
            }
        }
        if (corners_.size() > TriangleEdge::none / 3) {
            return failure("the model has more triangles than can be numbered");
        }
        if (without_area > 0) {
            say(counted(without_area, "face") + " of fewer than three different corners left out");
        }
        return {};
    }

    /// Keeps only the first of the triangles that have the same three points.
    void leave_out_doubles() {
        std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> keys;
        keys.reserve(corners_.size());
        for (std::uint32_t t = 0; t < corners_.size(); ++t) {
            std::array<std::uint32_t, 3> key = {point_of(corners_[t][0]), point_of(corners_[t][1]),
                                                point_of(corners_[t][2])};
            std::sort(key.begin(), key.end());
            keys.emplace_back(key, t);
        }
        sort_by_point(keys, soup_.points.size(), [](const auto& key) { return key.first[0]; });
        std::vector<bool> is_double(corners_.size());
        std::size_t count = 0;
        for (std::size_t k = 1; k < keys.size(); ++k) {
            if (keys[k].first != keys[k - 1].first) continue;
            is_double[keys[k].second] = true;
            ++count;
        }
        if (count == 0) return;
        std::size_t kept = 0;
        for (std::size_t t = 0; t < corners_.size(); ++t) {
            if (is_double[t]) continue;
            mesh().faces[kept] = mesh().faces[t];
            corners_[kept++] = corners_[t];
        }
        corners_.resize(kept);
        mesh().faces.resize(kept);
        say(counted(count, "face that was there twice was", "faces that were there twice were") +
            " left out");
    }

    void pair_and_orient() {
        for (const auto& corners : corners_) {
            mesh().triangles.push_back(
                {point_of(corners[0]), point_of(corners[1]), point_of(corners[2])});
        }
        EdgePairs pairs = pair_edges(soup_.points, mesh().triangles);
        if (pairs.non_manifold_edges > 0) {
            say(
                fmt::format("{} with more than two faces: faces that continue each other stay "
                            "connected there, and the others are cut",
                            counted(pairs.non_manifold_edges, "edge")));
        }
        const Orientation sides = orient(soup_.points, mesh().triangles, pairs.across);
        mesh().across = std::move(pairs.across);
        turn_triangles(sides.is_turned);
        if (sides.turned > 0) {
            say(counted(sides.turned, "face was", "faces were") +
                " turned to agree with the others");
        }
        if (sides.cut_edges > 0) {
            say(fmt::format("the surface had only one side and was cut along {}",
                            counted(sides.cut_edges, "edge")));
        }
        if (sides.inside_out > 0) {
            say(counted(sides.inside_out, "component was", "components were") +
                " turned inside out");
        }
    }

    void turn_triangles(const std::vector<bool>& is_turned) {
        for (std::size_t t = 0; t < is_turned.size(); ++t) {
            for (TriangleEdge& other : mesh().across[t]) {
                if (other.exists() && is_turned[other.triangle]) other.edge = 2 - other.edge;
            }
            if (!is_turned[t]) continue;
            std::swap(mesh().triangles[t][1], mesh().triangles[t][2]);
            std::swap(corners_[t][1], corners_[t][2]);
            std::swap(mesh().across[t][0], mesh().across[t][2]);
        }
    }

    /// Gives each fan of triangles its own point. Keeps the points in order.
    void split_fans() {
        const std::vector<std::uint32_t> sources = separate_fans(mesh());
        std::size_t doubled = 0;
        for (std::size_t k = 1; k < sources.size(); ++k) doubled += sources[k] == sources[k - 1];
        if (doubled > 0) {
            say(counted(doubled, "point was", "points were") +
                " doubled where the faces around it are not connected by edges");
        }
        take_from_soup(sources);
    }

    void take_from_soup(const std::vector<std::uint32_t>& sources) {
        for (const std::uint32_t source : sources) mesh().points.push_back(soup_.points[source]);
        for (const PointAttribute& attribute : soup_.attributes) {
            PointAttribute taken = attribute.without_values();
            for (const std::uint32_t source : sources)
                taken.values.push_back(attribute.values[source]);
            mesh().attributes.push_back(std::move(taken));
        }
        if (soup_.texture.empty()) return;
        for (const auto& corners : corners_) {
            mesh().texture.push_back(
                {soup_.texture[corners[0]], soup_.texture[corners[1]], soup_.texture[corners[2]]});
        }
    }

    Result<void> remove_flat() {
        const Result<FlatTriangles> flat = remove_flat_triangles(mesh());
        if (!flat) return tl::unexpected(flat.error());
        if (flat->merged + flat->left_out > 0) {
            say(counted(flat->merged + flat->left_out, "triangle") +
                " without area merged with neighbours");
        }
        if (flat->remaining > 0) say(counted(flat->remaining, "triangle") + " without area stayed");
        return {};
    }

    PolygonSoup soup_;
    std::vector<bool> is_used_;
    std::vector<std::uint32_t> joined_;  ///< The surviving point of each point.
    /// Triangles by their corners in the soup.
    std::vector<std::array<std::uint32_t, 3>> corners_;
    MadeMesh made_;
};

}  // namespace

Result<MadeMesh> make_mesh(PolygonSoup soup) { return MeshMaker(std::move(soup)).make(); }

}  // namespace cascade
