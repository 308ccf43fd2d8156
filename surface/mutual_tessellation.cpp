#include "surface/mutual_tessellation.h"

#include "core/hash.h"
#include "surface/place_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace cascade {

namespace {

/// The bits of two numbers by turns: places near each other on this curve are near in the triangle.
std::uint64_t along_curve(const Steps& steps) {
    std::uint64_t key = 0;
    for (int bit = 24; bit >= 0; --bit) {
        key = key << 2 | static_cast<std::uint64_t>(steps[1] >> bit & 1) << 1 |
              static_cast<std::uint64_t>(steps[2] >> bit & 1);
    }
    return key;
}

/// Triangle by triangle; within one in rounds of twice as many places each, chosen by chance, and
/// in each round along a curve.
std::vector<std::uint32_t> insertion_order(const std::vector<LatticePlace>& places) {
    using Entry = std::tuple<std::uint32_t, int, std::uint64_t, std::uint32_t>;
    std::vector<Entry> entries;
    entries.reserve(places.size());
    for (std::uint32_t k = 0; k < places.size(); ++k) {
        const int round = -std::countr_zero(pcg4d({k, 0, 0, 2})[0]);
        entries.emplace_back(places[k].triangle, round, along_curve(places[k].steps), k);
    }
    std::sort(entries.begin(), entries.end());
    std::vector<std::uint32_t> order;
    for (const Entry& entry : entries) order.push_back(std::get<3>(entry));
    return order;
}

/// Above 0 where d lies within the circle through a, b, c, by more than rounding can do.
bool is_in_circle(Vector2d a, Vector2d b, Vector2d c, Vector2d d) {
    a = a - d;
    b = b - d;
    c = c - d;
    const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const double bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double size = aa * (std::abs(b.x * c.y) + std::abs(b.y * c.x)) +
                        bb * (std::abs(c.x * a.y) + std::abs(c.y * a.x)) +
                        cc * (std::abs(a.x * b.y) + std::abs(a.y * b.x));
    return aa * bc + bb * ca + cc * ab > 1e-14 * size;
}

class Tessellator {
public:
    Tessellator(const SurfaceMesh& old, const std::vector<LatticePlace>& places)
        : old_(old),
          places_(places),
          made_{EditedMesh(old), {}, {}},
          origins_(old.triangles.size()) {
        for (std::uint32_t t = 0; t < origins_.size(); ++t) origins_[t] = t;
        made_.point_of_place.resize(places.size());
        take_normals();
    }

    MutualTessellation tessellate(const std::atomic<bool>& cancel) {
        const std::vector<std::uint32_t> order = insertion_order(places_);
        add_points();
        std::uint32_t near = TriangleEdge::none;
        for (const std::uint32_t place : order) {
            if (cancel) break;
            if (places_[place].corner() < 3) continue;
            const std::uint32_t triangle = places_[place].triangle;
            if (near == TriangleEdge::none || origins_[near] != triangle) near = triangle;
            near = insert(made_.point_of_place[place], triangle, near);
        }
        return std::move(made_);
    }

private:
    const SurfaceMesh& now() const { return made_.mesh.mesh(); }

    /// Of the old points, from the triangles around them by their areas.
    void take_normals() {
        made_.normals.resize(old_.points.size());
        for (std::size_t t = 0; t < old_.triangles.size(); ++t) {
            for (const std::uint32_t point : old_.triangles[t]) {
                made_.normals[point] = made_.normals[point] + old_.double_area_normal(t);
            }
        }
        for (Vector3d& normal : made_.normals) normal = unit(normal);
    }

    /// In the order of places, which is why their numbers do not depend on that of insertion.
    void add_points() {
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const LatticePlace& place = places_[k];
            std::uint32_t& point = made_.point_of_place[k];
            if (const std::uint32_t corner = place.corner(); corner < 3) {
                point = old_.triangles[place.triangle][corner];
                continue;
            }
            SurfacePlace rounded{place.triangle, {}};
            for (std::size_t c = 0; c < 3; ++c) {
                rounded.weights[c] = static_cast<double>(place.steps[c]) / lattice_steps;
            }
            point = made_.mesh.add_point(position_of(old_, rounded));
            place_of_point_.push_back(static_cast<std::uint32_t>(k));
            Vector3d normal = unit(old_.double_area_normal(place.triangle));
            if (const std::uint32_t edge = place.edge(); edge < 3) {
                const TriangleEdge other = old_.across[place.triangle][edge];
                if (other.exists()) normal = normal + unit(old_.double_area_normal(other.triangle));
            }
            made_.normals.push_back(unit(normal));
        }
    }

    /// Where a point of a triangle of the old mesh, or of its sides, lies in it.
    Steps steps_in(std::uint32_t origin, std::uint32_t point) const {
        if (point < old_.points.size()) {
            Steps steps{};
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (old_.triangles[origin][k] == point) steps[k] = lattice_steps;
            }
            return steps;
        }
        const LatticePlace& place = places_[place_of_point_[point - old_.points.size()]];
        if (place.triangle == origin) return place.steps;
        const std::uint32_t edge = place.edge();
        return steps_across(place.steps, edge, old_.across[place.triangle][edge].edge);
    }

    Vector2d flat(const Steps& steps) const {
        return frame_[1] * (static_cast<double>(steps[1]) / lattice_steps) +
               frame_[2] * (static_cast<double>(steps[2]) / lattice_steps);
    }

    std::array<Steps, 3> corners_of(std::uint32_t t) const {
        const auto [a, b, c] = now().triangles[t];
        const std::uint32_t origin = origins_[t];
        return {steps_in(origin, a), steps_in(origin, b), steps_in(origin, c)};
    }

    /// Where the walk to a point ends: its triangle, and one of its edges if the point lies on it.
    struct Found {
        std::uint32_t triangle = 0, edge = 3;
    };

    /// Walks over the edges that lie between, which of two first is left to chance: O. Devillers,
    /// S. Pion and M. Teillaud, "Walking in a triangulation", 2002. That never goes round in
    /// circles.
    Found locate(const Steps& point, std::uint32_t t) const {
        for (std::uint32_t step = 0;; ++step) {
            const std::array<Steps, 3> corners = corners_of(t);
            const std::uint32_t first = pcg4d({step, t, 0, 3})[0] % 3;
            std::uint32_t on = 3, leave = 3;
            for (std::uint32_t k = first; k < first + 3 && leave == 3; ++k) {
                const std::int64_t side = turn(corners[k % 3], corners[corner_after(k % 3)], point);
                if (side < 0) leave = k % 3;
                if (side == 0) on = k % 3;
            }
            if (leave == 3) return {t, on};
            t = now().across[t][leave].triangle;
        }
    }

    /// Returns a triangle at the point.
    std::uint32_t insert(std::uint32_t point, std::uint32_t origin, std::uint32_t near) {
        const Found found = locate(steps_in(origin, point), near);
        const std::uint32_t t = found.triangle;
        const auto added = static_cast<std::uint32_t>(origins_.size());
        if (found.edge == 3) {
            made_.mesh.split_triangle(t, point);
            origins_.insert(origins_.end(), 2, origin);
            restore({{t, 0}, {added, 0}, {added + 1, 0}}, origin, point);
            return t;
        }
        const TriangleEdge other = now().across[t][found.edge];
        made_.mesh.split_edge({t, found.edge}, point);
        origins_.push_back(origin);
        if (!other.exists()) {
            restore({{t, corner_before(found.edge)}, {added, 1}}, origin, point);
            return t;
        }
        const std::uint32_t there = origins_[other.triangle];
        origins_.push_back(there);
        restore({{t, corner_before(found.edge)}, {added, 1}}, origin, point);
        restore({{other.triangle, corner_before(other.edge)}, {added + 1, 1}}, there, point);
        return t;
    }

    /// Exchanges edges that face a new point until all its triangles are Delaunay triangles. Each
    /// edge is replaced by one of the point, of which there is a limited number.
    void restore(std::initializer_list<TriangleEdge> facing, std::uint32_t origin,
                 std::uint32_t point) {
        if (origin != framed_) {
            frame_ = own_frame(old_, origin);
            framed_ = origin;
        }
        const Steps p = steps_in(origin, point);
        suspects_.assign(facing);
        while (!suspects_.empty()) {
            const TriangleEdge edge = suspects_.back();
            suspects_.pop_back();
            const TriangleEdge other = now().across[edge.triangle][edge.edge];
            if (!other.exists() || origins_[other.triangle] != origin) continue;
            const auto& corners = now().triangles[edge.triangle];
            const Steps a = steps_in(origin, corners[edge.edge]);
            const Steps b = steps_in(origin, corners[corner_after(edge.edge)]);
            const Steps d = steps_in(origin, now().triangles[other.triangle][corner_before(other.edge)]);
            if (turn(p, d, b) <= 0 || turn(d, p, a) <= 0) continue;
            if (!is_in_circle(flat(a), flat(b), flat(p), flat(d))) continue;
            made_.mesh.exchange(edge);  // To (p, d, b) and (d, p, a).
            suspects_.push_back({edge.triangle, 1});
            suspects_.push_back({other.triangle, 2});
        }
    }

    const SurfaceMesh& old_;
    const std::vector<LatticePlace>& places_;
    MutualTessellation made_;
    std::vector<std::uint32_t> origins_;         ///< The old triangle in which each triangle lies.
    std::vector<std::uint32_t> place_of_point_;  ///< Of points that are not old.
    std::uint32_t framed_ = TriangleEdge::none;
    FlatTriangle frame_;  ///< Of the old triangle `framed_`.
    std::vector<TriangleEdge> suspects_;
};

Result<void> check_mesh(const SurfaceMesh& mesh, std::size_t places) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        if (a == b || b == c || c == a) {
            return failure(fmt::format("triangle {} of the surface has a corner twice", t));
        }
    }
    const std::size_t most = TriangleEdge::none;
    if (places >= most / 2 || mesh.triangles.size() >= most - 2 * places ||
        mesh.points.size() >= most - places) {
        return failure("the surface and its places have more points than can be numbered");
    }
    return {};
}

}  // namespace

Result<MutualTessellation> tessellate(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                                      const std::atomic<bool>& cancel) {
    if (Result<void> fine = check_mesh(mesh, places.size()); !fine) {
        return tl::unexpected(fine.error());
    }
    const Result<std::vector<LatticePlace>> lattice = to_lattice(mesh, places);
    if (!lattice) return tl::unexpected(lattice.error());
    MutualTessellation made = Tessellator(mesh, *lattice).tessellate(cancel);
    if (cancel) return failure("re-tiling the surface was stopped");
    return made;
}

}  // namespace cascade
