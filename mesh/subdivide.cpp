// OpenMesh makes the points and triangles. Everything else follows from the order in which OpenMesh
// makes them: a point for each edge, and three triangles at the corners of each old triangle.
#include "mesh/subdivide.h"

#include "core/counted.h"
#include "mesh/half_edges.h"

#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <algorithm>
#include <array>
#include <vector>

namespace cascade {

namespace {

/// The ends of each edge, in the order of edges.
using EdgeEnds = std::vector<std::array<std::uint32_t, 2>>;

EdgeEnds ends_of_edges(const HalfEdges& mesh) {
    EdgeEnds ends;
    for (const EdgeHandle e : mesh.edges()) {
        const HalfedgeHandle h = mesh.halfedge_handle(e, 0);
        ends.push_back({number(mesh.from_vertex_handle(h)), number(mesh.to_vertex_handle(h))});
    }
    return ends;
}

void halve_edges(HalfEdges& mesh) {
    unsigned largest = 0;
    for (const VertexHandle v : mesh.vertices()) largest = std::max(largest, mesh.valence(v));
    OpenMesh::Subdivider::Uniform::LoopT<HalfEdges> loop;
    loop.init_weights(largest + 1);  // OpenMesh prepares weights for 49 neighbours only.
    loop.attach(mesh);
    loop(1);
    loop.detach();
}

void halve_attributes(const EdgeEnds& edges, std::vector<PointAttribute>& attributes) {
    for (PointAttribute& attribute : attributes) {
        for (const auto& [a, b] : edges) {
            attribute.values.push_back((attribute.values[a] + attribute.values[b]) / 2);
        }
    }
}

/// The texture coordinates of the triangles of `fine`. Each of these triangles is a part of a
/// triangle of `coarse`.
std::vector<std::array<TexturePlace, 3>> halved_texture(const SurfaceMesh& coarse,
                                                        const EdgeEnds& edges,
                                                        const SurfaceMesh& fine) {
    const std::size_t old_points = coarse.points.size(), old = coarse.triangles.size();
    std::vector<std::array<TexturePlace, 3>> texture(fine.triangles.size());
    for (std::size_t t = 0; t < texture.size(); ++t) {
        const std::size_t parent = t < old ? t : (t - old) / 3;
        const auto at = [&](std::uint32_t point) -> const TexturePlace& {
            const auto& corners = coarse.triangles[parent];
            const auto corner = std::find(corners.begin(), corners.end(), point);
            return coarse.texture[parent][static_cast<std::size_t>(corner - corners.begin())];
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t point = fine.triangles[t][k];
            if (point < old_points) {
                texture[t][k] = at(point);
                continue;
            }
            const auto& [a, b] = edges[point - old_points];
            const TexturePlace &from = at(a), &to = at(b);
            texture[t][k] = {(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
        }
    }
    return texture;
}

Result<SurfaceMesh> subdivide_once(const SurfaceMesh& mesh) {
    Result<HalfEdges> edited = half_edges(mesh);
    if (!edited) return tl::unexpected(edited.error());
    const EdgeEnds edges = ends_of_edges(*edited);
    halve_edges(*edited);
    SurfaceMesh result = surface_mesh(*edited);
    result.attributes = mesh.attributes;
    halve_attributes(edges, result.attributes);
    if (!mesh.texture.empty()) result.texture = halved_texture(mesh, edges, result);
    return result;
}

}  // namespace

Result<SurfaceMesh> subdivide(const SurfaceMesh& mesh, int times) {
    const std::size_t triangles = mesh.triangles.size() << (2 * times);
    if (triangles > most_subdivided) {
        return failure(counted(static_cast<std::int64_t>(triangles), "triangle") +
                           " would be made, more than the limit of " +
                           counted(most_subdivided, "triangle"),
                       "subdivide it less often");
    }
    Result<SurfaceMesh> result = mesh;
    for (int k = 0; k < times && result; ++k) result = subdivide_once(*result);
    return result;
}

}  // namespace cascade
