// Converts between SurfaceMesh, which is for reading, and half-edges, which are for editing.
#include "mesh/half_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace cascade {

namespace {

class Converter {
public:
    explicit Converter(const SurfaceMesh& mesh) : mesh_(mesh), half_edges_(mesh.triangles.size()) {}

    Result<void> convert(HalfEdges& made) {
        if (std::max(mesh_.points.size(), mesh_.triangles.size()) > most_faces) {
            return failure("the surface has more points or triangles than can be numbered");
        }
        if (Result<void> fine = number_edges(); !fine) return fine;
        made.resize(mesh_.points.size(), edges_, mesh_.triangles.size());
        add_faces(made);
        if (Result<void> fine = add_boundaries(made); !fine) return fine;
        return check_fans(made);
    }

private:
    static FaceHandle face(std::size_t t) { return FaceHandle(static_cast<int>(t)); }
    VertexHandle corner(TriangleEdge e) const {
        return vertex(mesh_.triangles[e.triangle][e.edge]);
    }
    TriangleEdge across(TriangleEdge e) const { return mesh_.across[e.triangle][e.edge]; }
    static TriangleEdge next(TriangleEdge e) { return {e.triangle, corner_after(e.edge)}; }

    template <typename Visit>
    void each_edge(const Visit& visit) const {
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) visit(TriangleEdge{t, k});
        }
    }
    HalfedgeHandle& half_edge(TriangleEdge e) { return half_edges_[e.triangle][e.edge]; }

    bool fits(TriangleEdge here, TriangleEdge other) const {
        return other.triangle < mesh_.triangles.size() && other.edge < 3 && other != here &&
               across(other) == here && corner(here) == corner(next(other)) &&
               corner(next(here)) == corner(other);
    }

    /// Numbers edges. The first half-edge of each edge belongs to the triangle with the lower
    /// index.
    Result<void> number_edges() {
        if (mesh_.across.size() != mesh_.triangles.size()) {
            return failure("the surface has triangles whose neighbours are not known");
        }
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            const auto [a, b, c] = mesh_.triangles[t];
            if (a == b || b == c || c == a) {
                return failure(fmt::format("triangle {} of the surface has a corner twice", t));
            }
            for (std::uint32_t k = 0; k < 3; ++k) {
                const TriangleEdge here{t, k}, other = across(here);
                if (corner(here).idx() >= static_cast<int>(mesh_.points.size()) ||
                    (other.exists() && !fits(here, other))) {
                    return failure(
                        fmt::format("edge {} of triangle {} of the surface does not match "
                                    "the triangle across it",
                                    k, t));
                }
                const bool is_first =
                    !other.exists() || std::tie(t, k) < std::tie(other.triangle, other.edge);
                half_edge(here) = HalfedgeHandle(is_first ? static_cast<int>(2 * edges_++)
                                                          : half_edge(other).idx() + 1);
            }
        }
        return {};
    }

    void add_faces(HalfEdges& made) {
        for (std::uint32_t p = 0; p < mesh_.points.size(); ++p) {
            const Vector3d& at = mesh_.points[p];
            made.set_point(vertex(p), {at.x, at.y, at.z});
        }
        each_edge([&](TriangleEdge e) {
            const HalfedgeHandle h = half_edge(e);
            made.set_vertex_handle(h, corner(next(e)));
            made.set_face_handle(h, face(e.triangle));
            made.set_next_halfedge_handle(h, half_edge(next(e)));
            made.set_halfedge_handle(corner(e), h);
            if (e.edge == 0) made.set_halfedge_handle(face(e.triangle), h);
        });
    }

    /// Sets the outgoing half-edge of each boundary vertex to its boundary half-edge.
    Result<void> add_boundaries(HalfEdges& made) {
        std::vector<HalfedgeHandle> boundary;
        each_edge([&](TriangleEdge e) {
            if (across(e).exists()) return;
            boundary.push_back(made.opposite_halfedge_handle(half_edge(e)));
            made.set_vertex_handle(boundary.back(), corner(e));
        });
        for (const HalfedgeHandle h : boundary) {
            const VertexHandle from = made.from_vertex_handle(h);
            if (made.is_boundary(made.halfedge_handle(from))) return several_fans(number(from));
            made.set_halfedge_handle(from, h);
        }
        for (const HalfedgeHandle h : boundary) {
            made.set_next_halfedge_handle(h, made.halfedge_handle(made.to_vertex_handle(h)));
        }
        return {};
    }

    static tl::unexpected<Failure> several_fans(std::size_t point) {
        return failure(
            fmt::format("the triangles around point {} of the surface are not one fan", point));
    }

    /// Fails unless the triangles around each point form one fan.
    Result<void> check_fans(const HalfEdges& made) const {
        std::vector<std::uint32_t> corners(mesh_.points.size());
        each_edge([&](TriangleEdge e) { ++corners[number(corner(e))]; });
        for (std::uint32_t p = 0; p < corners.size(); ++p) {
            if (corners[p] == 0) continue;
            const HalfedgeHandle first = made.halfedge_handle(vertex(p));
            HalfedgeHandle at = first;
            do {
                corners[p] -= !made.is_boundary(at);
                at = made.next_halfedge_handle(made.opposite_halfedge_handle(at));
            } while (at != first);
            if (corners[p] != 0) return several_fans(p);
        }
        return {};
    }

    const SurfaceMesh& mesh_;
    std::vector<std::array<HalfedgeHandle, 3>> half_edges_;  ///< One per triangle and edge.
    std::size_t edges_ = 0;
};

}  // namespace

Result<HalfEdges> half_edges(const SurfaceMesh& mesh) {
    // The only object that is returned, so that returning does not copy the mesh.
    Result<HalfEdges> made;
    if (Result<void> fine = Converter(mesh).convert(*made); !fine)
        made = tl::unexpected(fine.error());
    return made;
}

SurfaceMesh surface_mesh(const HalfEdges& mesh, std::span<const std::uint32_t> vertices) {
    SurfaceMesh result;
    std::vector<std::uint32_t> points(mesh.n_vertices());
    for (const std::uint32_t v : vertices) {
        points[v] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(position(mesh, vertex(v)));
    }
    // The triangle edge of each half-edge that has a face.
    std::vector<TriangleEdge> places(mesh.n_halfedges());
    const auto place = [&](HalfedgeHandle h) -> TriangleEdge& {
        return places[static_cast<std::size_t>(h.idx())];
    };
    for (const FaceHandle f : mesh.faces()) {
        const auto t = static_cast<std::uint32_t>(result.triangles.size());
        auto& triangle = result.triangles.emplace_back();
        HalfedgeHandle h = mesh.halfedge_handle(f);
        for (std::uint32_t k = 0; k < 3; ++k, h = mesh.next_halfedge_handle(h)) {
            triangle[k] = points[number(mesh.from_vertex_handle(h))];
            place(h) = {t, k};
        }
    }
    result.across.resize(result.triangles.size());
    for (int h = 0; h < static_cast<int>(places.size()); ++h) {
        const TriangleEdge here = place(HalfedgeHandle(h));
        if (!here.exists()) continue;
        result.across[here.triangle][here.edge] =
            place(mesh.opposite_halfedge_handle(HalfedgeHandle(h)));
    }
    return result;
}

SurfaceMesh surface_mesh(const HalfEdges& mesh) {
    std::vector<std::uint32_t> vertices;
    for (const VertexHandle v : mesh.vertices()) vertices.push_back(number(v));
    return surface_mesh(mesh, vertices);
}

void outgoing(const HalfEdges& mesh, VertexHandle v, std::vector<HalfedgeHandle>& spokes) {
    const auto next = [&](HalfedgeHandle h) {
        return mesh.opposite_halfedge_handle(mesh.prev_halfedge_handle(h));
    };
    spokes.clear();
    const HalfedgeHandle any = mesh.halfedge_handle(v);
    const HalfedgeHandle first = mesh.is_boundary(any) ? next(any) : any;
    HalfedgeHandle at = first;
    do {
        spokes.push_back(at);
        at = next(at);
    } while (at != first);
}

bool are_neighbours(const HalfEdges& mesh, VertexHandle a, VertexHandle b) {
    auto near_a = mesh.cvv_iter(a), near_b = mesh.cvv_iter(b);
    for (; near_a.is_valid() && near_b.is_valid(); ++near_a, ++near_b) {
        if (*near_a == b || *near_b == a) return true;
    }
    return false;
}

}  // namespace cascade
