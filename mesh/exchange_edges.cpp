#include "mesh/exchange_edges.h"

#include "mesh/separate_fans.h"

#include <algorithm>
#include <type_traits>

namespace cascade {

namespace {

constexpr double flat = 1e-10;
constexpr int most_rounds = 8;  ///< A strip of flat triangles takes several.

std::uint32_t longest_edge(const SurfaceMesh& mesh, std::uint32_t t) {
    std::uint32_t longest = 0;
    double best = -1;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const double size = length(mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k));
        if (size > best) {
            best = size;
            longest = k;
        }
    }
    return longest;
}

bool is_flat(const SurfaceMesh& mesh, std::uint32_t t) {
    const std::uint32_t k = longest_edge(mesh, t);
    const Vector3d along = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
    return length(mesh.double_area_normal(t)) <= flat * dot(along, along);
}

void link(SurfaceMesh& mesh, TriangleEdge here, TriangleEdge other) {
    mesh.across[here.triangle][here.edge] = other;
    if (other.exists()) mesh.across[other.triangle][other.edge] = here;
}

/// Takes triangles away; their neighbours get a boundary.
void leave_out(SurfaceMesh& mesh, const std::vector<bool>& is_out) {
    std::vector<std::uint32_t> numbers(mesh.triangles.size(), TriangleEdge::none);
    std::uint32_t kept = 0;
    for (std::uint32_t t = 0; t < numbers.size(); ++t) {
        if (is_out[t]) continue;
        numbers[t] = kept;
        mesh.triangles[kept] = mesh.triangles[t];
        mesh.across[kept] = mesh.across[t];
        if (!mesh.texture.empty()) mesh.texture[kept] = mesh.texture[t];
        if (!mesh.faces.empty()) mesh.faces[kept] = mesh.faces[t];
        ++kept;
    }
    mesh.triangles.resize(kept);
    mesh.across.resize(kept);
    if (!mesh.texture.empty()) mesh.texture.resize(kept);
    if (!mesh.faces.empty()) mesh.faces.resize(kept);
    for (auto& edges : mesh.across) {
        for (TriangleEdge& other : edges) {
            if (!other.exists()) continue;
            other = numbers[other.triangle] == TriangleEdge::none
                        ? TriangleEdge{}
                        : TriangleEdge{numbers[other.triangle], other.edge};
        }
    }
}

/// Without points that no triangle uses any more, and with more of those at which what was left out
/// held parts together.
void renew_points(SurfaceMesh& mesh) {
    const std::vector<std::uint32_t> sources = separate_fans(mesh);
    const auto taken = [&](const auto& old) {
        std::remove_cvref_t<decltype(old)> values;
        values.reserve(sources.size());
        for (const std::uint32_t source : sources) values.push_back(old[source]);
        return values;
    };
    mesh.points = taken(mesh.points);
    for (PointAttribute& attribute : mesh.attributes) attribute.values = taken(attribute.values);
}

}  // namespace

void exchange_edge(SurfaceMesh& mesh, TriangleEdge edge) {
    // Triangles (a, b, c) and (b, a, d) become (c, d, b) and (d, c, a).
    const std::uint32_t t = edge.triangle, k = edge.edge;
    const TriangleEdge other = mesh.across[t][k];
    const std::uint32_t o = other.triangle, m = other.edge;
    const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
    const std::uint32_t c = mesh.triangles[t][(k + 2) % 3], d = mesh.triangles[o][(m + 2) % 3];
    const TriangleEdge beyond_bc = mesh.across[t][(k + 1) % 3];
    const TriangleEdge beyond_ca = mesh.across[t][(k + 2) % 3];
    const TriangleEdge beyond_ad = mesh.across[o][(m + 1) % 3];
    const TriangleEdge beyond_db = mesh.across[o][(m + 2) % 3];
    if (!mesh.texture.empty()) {
        const auto here = mesh.texture[t];
        const auto there = mesh.texture[o];
        mesh.texture[t] = {here[(k + 2) % 3], there[(m + 2) % 3], there[m]};
        mesh.texture[o] = {there[(m + 2) % 3], here[(k + 2) % 3], there[(m + 1) % 3]};
    }
    mesh.triangles[t] = {c, d, b};
    mesh.triangles[o] = {d, c, a};
    link(mesh, {t, 0}, {o, 0});
    link(mesh, {t, 1}, beyond_db);
    link(mesh, {t, 2}, beyond_bc);
    link(mesh, {o, 1}, beyond_ca);
    link(mesh, {o, 2}, beyond_ad);
}

ExchangedEdges remove_flat_triangles(SurfaceMesh& mesh) {
    ExchangedEdges done;
    std::vector<bool> is_out(mesh.triangles.size());
    for (int round = 0; round < most_rounds; ++round) {
        bool changed = false;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            if (is_out[t] || !is_flat(mesh, t)) continue;
            const std::uint32_t k = longest_edge(mesh, t);
            const TriangleEdge other = mesh.across[t][k];
            if (!other.exists()) {
                is_out[t] = true;
                for (std::uint32_t e = 0; e < 3; ++e) {
                    const TriangleEdge beyond = mesh.across[t][e];
                    if (beyond.exists()) mesh.across[beyond.triangle][beyond.edge] = {};
                }
                mesh.across[t] = {};
                ++done.left_out;
                changed = true;
            } else if (other.triangle != t && !is_flat(mesh, other.triangle)) {
                exchange_edge(mesh, {t, k});
                if (!mesh.faces.empty()) mesh.faces[t] = mesh.faces[other.triangle];
                ++done.exchanged;
                changed = true;
            }
        }
        if (!changed) break;
    }
    if (done.left_out > 0) {
        leave_out(mesh, is_out);
        renew_points(mesh);
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) done.remaining += is_flat(mesh, t);
    return done;
}

}  // namespace cascade
