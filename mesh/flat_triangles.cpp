// OpenMesh flips edges and deletes triangles. This file updates texture coordinates and model
// faces.
#include "mesh/flat_triangles.h"

#include "mesh/half_edges.h"
#include "mesh/separate_fans.h"

#include <type_traits>

namespace cascade {

namespace {

constexpr double flatness = 1e-10;
constexpr int most_rounds = 8;  ///< A strip of flat triangles takes several rounds.

using Corners = std::array<Vector3d, 3>;

std::uint32_t longest_edge(const Corners& corners) {
    std::uint32_t longest = 0;
    double best = -1;
    for (std::uint32_t k = 0; k < 3; ++k) {
        const double size = length(corners[corner_after(k)] - corners[k]);
        if (size > best) {
            best = size;
            longest = k;
        }
    }
    return longest;
}

bool is_flat(const Corners& corners) {
    const std::uint32_t k = longest_edge(corners);
    const Vector3d along = corners[corner_after(k)] - corners[k];
    const Vector3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    return length(normal) <= flatness * dot(along, along);
}

std::size_t count_flat(const SurfaceMesh& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        count += is_flat({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)});
    }
    return count;
}

class FlatTriangleRemover {
public:
    FlatTriangleRemover(SurfaceMesh& old, HalfEdges& mesh) : old_(old), mesh_(mesh) {
        if (old.texture.empty()) return;
        texture_.resize(mesh.n_halfedges());
        for (const FaceHandle f : mesh.faces()) {
            const auto sides = sides_of(f);
            for (std::size_t k = 0; k < 3; ++k) texture(sides[k]) = old.texture[index(f)][k];
        }
    }

    FlatTriangles run() {
        bool is_changed = true;
        for (int round = 0; round < most_rounds && is_changed; ++round) {
            is_changed = false;
            for (const FaceHandle f : mesh_.all_faces()) {
                if (!mesh_.status(f).deleted() && is_flat(corners_of(f))) is_changed |= remove(f);
            }
        }
        put_back();
        done_.remaining = count_flat(old_);
        return done_;
    }

private:
    static std::size_t index(FaceHandle f) { return static_cast<std::size_t>(f.idx()); }

    std::array<HalfedgeHandle, 3> sides_of(FaceHandle f) const {
        const HalfedgeHandle h = mesh_.halfedge_handle(f);
        return {h, mesh_.next_halfedge_handle(h), mesh_.prev_halfedge_handle(h)};
    }

    Corners corners_of(FaceHandle f) const {
        Corners corners;
        const auto sides = sides_of(f);
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = position(mesh_, mesh_.from_vertex_handle(sides[k]));
        }
        return corners;
    }

    /// The texture coordinates of the corner where a half-edge begins.
    TexturePlace& texture(HalfedgeHandle h) { return texture_[static_cast<std::size_t>(h.idx())]; }

    /// Removes a flat triangle if possible, and returns whether this was possible.
    bool remove(FaceHandle f) {
        const HalfedgeHandle h = sides_of(f)[longest_edge(corners_of(f))];
        const FaceHandle other = mesh_.opposite_face_handle(h);
        if (!other.is_valid()) {
            mesh_.delete_face(f, false);
            ++done_.left_out;
            return true;
        }
        const EdgeHandle e = mesh_.edge_handle(h);
        if (is_flat(corners_of(other)) || !mesh_.is_flip_ok(e)) return false;
        const HalfedgeHandle o = mesh_.opposite_halfedge_handle(h),
                             bc = mesh_.next_halfedge_handle(h);
        if (!texture_.empty())
            texture(bc) = texture(o);  // Both new triangles are parts of `other`.
        mesh_.flip(e);
        if (!texture_.empty()) {
            texture(h) = texture(mesh_.next_halfedge_handle(o));
            texture(o) = texture(mesh_.next_halfedge_handle(h));
        }
        if (!old_.faces.empty()) old_.faces[index(f)] = old_.faces[index(other)];
        ++done_.merged;
        return true;
    }

    void put_back() {
        SurfaceMesh mesh = surface_mesh(mesh_);
        for (const FaceHandle f : mesh_.faces()) {
            if (!old_.faces.empty()) mesh.faces.push_back(old_.faces[index(f)]);
            if (texture_.empty()) continue;
            const auto sides = sides_of(f);
            mesh.texture.push_back({texture(sides[0]), texture(sides[1]), texture(sides[2])});
        }
        mesh.attributes = std::move(old_.attributes);
        old_ = std::move(mesh);
        if (done_.left_out > 0) renew_points();
    }

    /// After deletions, removes points without triangles and splits points with several fans.
    void renew_points() {
        const std::vector<std::uint32_t> sources = separate_fans(old_);
        const auto taken = [&](const auto& old) {
            std::remove_cvref_t<decltype(old)> values;
            values.reserve(sources.size());
            for (const std::uint32_t source : sources) values.push_back(old[source]);
            return values;
        };
        old_.points = taken(old_.points);
        for (PointAttribute& attribute : old_.attributes)
            attribute.values = taken(attribute.values);
    }

    SurfaceMesh& old_;
    HalfEdges& mesh_;
    /// The texture coordinates of each half-edge. Empty if the mesh has no texture coordinates.
    std::vector<TexturePlace> texture_;
    FlatTriangles done_;
};

}  // namespace

Result<FlatTriangles> remove_flat_triangles(SurfaceMesh& mesh) {
    if (count_flat(mesh) == 0) return FlatTriangles{};
    Result<HalfEdges> edited = half_edges(mesh);
    if (!edited) return tl::unexpected(edited.error());
    return FlatTriangleRemover(mesh, *edited).run();
}

}  // namespace cascade
