// Connected components, boundaries and the Euler characteristic, from the adjacency.
#include "mesh/surface_mesh.h"

#include <algorithm>

namespace cascade {

double SurfaceMesh::angle(std::size_t triangle, std::size_t k) const {
    const Vector3d here = corner(triangle, k);
    const Vector3d a = unit(corner(triangle, corner_after(k)) - here);
    const Vector3d b = unit(corner(triangle, corner_before(k)) - here);
    return std::atan2(length(cross(a, b)), dot(a, b));
}

double SurfaceMesh::total_area() const {
    double sum = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) sum += area(t);
    return sum;
}

SurfaceMesh::Box SurfaceMesh::box() const {
    Box box;
    if (!points.empty()) box.low = box.high = points[0];
    for (const Vector3d& p : points) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                    std::max(box.high.z, p.z)};
    }
    return box;
}

std::vector<std::uint32_t> connected_components(const SurfaceMesh& mesh) {
    std::vector<std::uint32_t> components(mesh.triangles.size(), TriangleEdge::none);
    std::vector<std::uint32_t> waiting;
    std::uint32_t count = 0;
    for (std::uint32_t start = 0; start < components.size(); ++start) {
        if (components[start] != TriangleEdge::none) continue;
        components[start] = count;
        waiting.push_back(start);
        while (!waiting.empty()) {
            const std::uint32_t triangle = waiting.back();
            waiting.pop_back();
            for (const TriangleEdge& other : mesh.across[triangle]) {
                if (!other.exists() || components[other.triangle] != TriangleEdge::none) continue;
                components[other.triangle] = count;
                waiting.push_back(other.triangle);
            }
        }
        ++count;
    }
    return components;
}

namespace {

/// The boundary edge that begins where `edge` ends.
TriangleEdge next_of_boundary(const SurfaceMesh& mesh, TriangleEdge edge) {
    TriangleEdge next = {edge.triangle, (edge.edge + 1) % 3};
    for (;;) {
        const TriangleEdge other = mesh.across[next.triangle][next.edge];
        if (!other.exists()) return next;
        next = {other.triangle, (other.edge + 1) % 3};
    }
}

std::size_t count_boundaries(const SurfaceMesh& mesh) {
    std::vector<std::array<bool, 3>> seen(mesh.triangles.size());
    std::size_t loops = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (mesh.across[t][k].exists() || seen[t][k]) continue;
            ++loops;
            for (TriangleEdge at = {t, k}; !seen[at.triangle][at.edge];
                 at = next_of_boundary(mesh, at)) {
                seen[at.triangle][at.edge] = true;
            }
        }
    }
    return loops;
}

}  // namespace

MeshFacts facts_of(const SurfaceMesh& mesh) {
    MeshFacts facts;
    facts.points = mesh.points.size();
    facts.triangles = mesh.triangles.size();
    facts.area = mesh.total_area();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const TriangleEdge& other : mesh.across[t]) facts.boundary_edges += !other.exists();
    }
    facts.edges = (3 * facts.triangles + facts.boundary_edges) / 2;
    facts.boundaries = count_boundaries(mesh);
    const std::vector<std::uint32_t> components = connected_components(mesh);
    facts.components =
        components.empty() ? 0 : *std::max_element(components.begin(), components.end()) + 1;
    facts.euler_characteristic = static_cast<std::int64_t>(facts.points + facts.triangles) -
                                 static_cast<std::int64_t>(facts.edges);
    const SurfaceMesh::Box box = mesh.box();
    facts.low = box.low;
    facts.high = box.high;
    return facts;
}

}  // namespace cascade
