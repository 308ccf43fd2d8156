#include "surface/edited_mesh.h"

#include "core/check.h"
#include "mesh/exchange_edges.h"
#include "mesh/flat.h"

namespace cascade {

EditedMesh::EditedMesh(const SurfaceMesh& mesh) : corner_of_(mesh.points.size()) {
    mesh_.points = mesh.points;
    mesh_.triangles = mesh.triangles;
    mesh_.across = mesh.across;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) set_triangle(t, mesh.triangles[t]);
}

void EditedMesh::set_triangle(std::uint32_t t, std::array<std::uint32_t, 3> corners) {
    mesh_.triangles[t] = corners;
    changed_.push_back(t);
    for (std::uint32_t k = 0; k < 3; ++k) corner_of_[corners[k]] = {t, k};
}

void EditedMesh::link(TriangleEdge here, TriangleEdge other) {
    if (here.exists()) mesh_.across[here.triangle][here.edge] = other;
    if (other.exists()) mesh_.across[other.triangle][other.edge] = here;
}

std::uint32_t EditedMesh::add_point(Vector3d position) {
    mesh_.points.push_back(position);
    corner_of_.emplace_back();
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
}

void EditedMesh::split_triangle(std::uint32_t t, std::uint32_t point) {
    const auto [a, b, c] = mesh_.triangles[t];
    const auto [ab, bc, ca] = mesh_.across[t];
    const auto second = static_cast<std::uint32_t>(mesh_.triangles.size()), third = second + 1;
    mesh_.triangles.resize(third + 1);
    mesh_.across.resize(third + 1);
    set_triangle(t, {a, b, point});
    set_triangle(second, {b, c, point});
    set_triangle(third, {c, a, point});
    link({second, 0}, bc);
    link({third, 0}, ca);
    link({t, 1}, {second, 2});
    link({second, 1}, {third, 2});
    link({third, 1}, {t, 2});
}

void EditedMesh::split_edge(TriangleEdge edge, std::uint32_t point) {
    // (a, b, c) becomes (a, p, c) and (p, b, c), and (b, a, d) across it (b, p, d) and (p, a, d).
    const TriangleEdge other = mesh_.across[edge.triangle][edge.edge];
    const auto halve = [&](TriangleEdge side) {
        const std::uint32_t t = side.triangle, k = side.edge;
        const std::uint32_t b = mesh_.triangles[t][corner_after(k)], c = mesh_.triangles[t][corner_before(k)];
        const TriangleEdge bc = mesh_.across[t][corner_after(k)];
        const auto added = static_cast<std::uint32_t>(mesh_.triangles.size());
        mesh_.triangles.emplace_back();
        mesh_.across.emplace_back();
        set_triangle(added, {point, b, c});
        std::array<std::uint32_t, 3> corners = mesh_.triangles[t];
        corners[corner_after(k)] = point;
        set_triangle(t, corners);
        link({added, 1}, bc);
        link({added, 2}, {t, corner_after(k)});
        return added;
    };
    const std::uint32_t added = halve(edge);
    if (!other.exists()) return;
    const std::uint32_t added_there = halve(other);
    link(edge, {added_there, 0});
    link({added, 0}, other);
}

void EditedMesh::exchange(TriangleEdge edge) {
    const std::uint32_t other = mesh_.across[edge.triangle][edge.edge].triangle;
    exchange_edge(mesh_, edge);
    set_triangle(edge.triangle, mesh_.triangles[edge.triangle]);
    set_triangle(other, mesh_.triangles[other]);
}

/// The corner of the next triangle counterclockwise around the same point.
TriangleEdge EditedMesh::next_around(TriangleEdge corner) const {
    return mesh_.across[corner.triangle][corner_before(corner.edge)];
}

TriangleEdge EditedMesh::previous_around(TriangleEdge corner) const {
    const TriangleEdge other = mesh_.across[corner.triangle][corner.edge];
    return other.exists() ? TriangleEdge{other.triangle, corner_after(other.edge)} : other;
}

void EditedMesh::fan_around(std::uint32_t point, Fan& fan) const {
    fan.triangles.clear();
    fan.rim.clear();
    fan.beyond.clear();
    const TriangleEdge start = corner_of_[point];
    TriangleEdge first = start;
    for (;;) {
        const TriangleEdge previous = previous_around(first);
        fan.is_closed = previous == start;
        if (fan.is_closed || !previous.exists()) break;
        first = previous;
    }
    TriangleEdge at = first;
    do {
        const auto& corners = mesh_.triangles[at.triangle];
        fan.triangles.push_back(at.triangle);
        fan.rim.push_back(corners[corner_after(at.edge)]);
        fan.beyond.push_back(mesh_.across[at.triangle][corner_after(at.edge)]);
        const TriangleEdge next = next_around(at);
        if (!next.exists()) fan.rim.push_back(corners[corner_before(at.edge)]);
        at = next;
    } while (at.exists() && at != first);
}

bool EditedMesh::are_neighbours(std::uint32_t a, std::uint32_t b) const {
    struct Walk {
        TriangleEdge start, at;
        std::uint32_t wanted;
        bool is_back = false, is_done = false;
    };
    std::array<Walk, 2> walks = {Walk{corner_of_[a], corner_of_[a], b},
                                 Walk{corner_of_[b], corner_of_[b], a}};
    for (;;) {
        for (Walk& walk : walks) {
            const auto& corners = mesh_.triangles[walk.at.triangle];
            if (corners[corner_after(walk.at.edge)] == walk.wanted ||
                corners[corner_before(walk.at.edge)] == walk.wanted) {
                return true;
            }
            TriangleEdge next = walk.is_back ? previous_around(walk.at) : next_around(walk.at);
            if (!next.exists() && !walk.is_back) {
                walk.is_back = true;
                next = previous_around(walk.start);
            }
            if (!next.exists() || next == walk.start) return false;
            walk.at = next;
        }
    }
}

void EditedMesh::replace_fan(std::uint32_t point, const Fan& fan,
                             std::span<const std::array<std::uint32_t, 3>> ears) {
    CHECK(ears.size() + 2 == fan.rim.size(), "a rim of n points takes n - 2 triangles");
    const std::size_t last = fan.rim.size() - 1;
    std::vector<TriangleEdge> beyond = fan.beyond;
    if (!fan.is_closed) beyond.emplace_back();
    for (std::size_t k = 0; k < ears.size(); ++k) {
        const auto [a, b, c] = ears[k];
        const std::uint32_t t = fan.triangles[k];
        set_triangle(t, {fan.rim[a], fan.rim[b], fan.rim[c]});
        mesh_.across[t] = {};
        link({t, 0}, beyond[a]);
        link({t, 1}, beyond[b]);
        if (k + 1 == ears.size()) link({t, 2}, beyond[c]);
        else beyond[a] = {t, 2};
    }
    if (ears.empty()) {  // A boundary triangle; behind it begins the boundary now.
        mesh_.across[beyond[0].triangle][beyond[0].edge] = {};
        set_triangle(beyond[0].triangle, mesh_.triangles[beyond[0].triangle]);
        CHECK(last == 1, "two points are left of a fan of one triangle");
    }
    for (std::size_t k = ears.size(); k < fan.triangles.size(); ++k) {
        mesh_.triangles[fan.triangles[k]].fill(TriangleEdge::none);
        mesh_.across[fan.triangles[k]] = {};
    }
    corner_of_[point] = {};
}

SurfaceMesh EditedMesh::without_gaps(std::span<const std::uint32_t> kept) const {
    SurfaceMesh result;
    std::vector<std::uint32_t> points(mesh_.points.size(), TriangleEdge::none);
    for (const std::uint32_t point : kept) {
        points[point] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(mesh_.points[point]);
    }
    std::vector<std::uint32_t> triangles(mesh_.triangles.size(), TriangleEdge::none);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        if (!has_triangle(t)) continue;
        triangles[t] = static_cast<std::uint32_t>(result.triangles.size());
        const auto [a, b, c] = mesh_.triangles[t];
        result.triangles.push_back({points[a], points[b], points[c]});
        result.across.push_back(mesh_.across[t]);
    }
    for (auto& edges : result.across) {
        for (TriangleEdge& other : edges) {
            if (other.exists()) other.triangle = triangles[other.triangle];
        }
    }
    return result;
}

}  // namespace cascade
