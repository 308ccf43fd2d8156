// Removes old points in rounds and improves edges after each round. New triangles are tested
// strictly in the first rounds and less strictly in later ones.
#include "surface/retile.h"

#include "mesh/half_edges.h"
#include "surface/mutual_tessellation.h"
#include "surface/remove_points.h"
#include "surface/triangle_quality.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <vector>

namespace cascade {

namespace {

// Improves triangles by flipping edges.

/// Flips an edge if that improves the worst of its ratings. These are the ratings of the edge's two
/// triangles (TriangleQuality::score()), of the fold at the edge, and of the folds at the
/// triangles' four other sides. On a plane this is Lawson's algorithm for the Delaunay
/// triangulation, which maximises the smallest angle (R. Sibson, "Locally equiangular
/// triangulations", 1978). Turns no triangle upside down and creates no second edge between two
/// points.
class EdgeFlipper {
public:
    /// `normals` are the surface's normals at the points. Queues the edges of all faces.
    EdgeFlipper(HalfEdges& mesh, std::span<const Vector3d> normals);

    /// Queues the edges of a changed face, unless it is deleted.
    void look_at(FaceHandle f);

    /// Processes the queue, including the edges of faces that change meanwhile. Terminates because
    /// every flip increases the sorted list of the scores of all triangles and edges. Stops early
    /// when `cancel` becomes true.
    void improve(const std::atomic<bool>& cancel);

private:
    /// The rating of an existing or possible triangle.
    struct Face {
        double score = 0;
        bool is_upright = true;
        Vector3d direction;  ///< The unit normal.
    };
    Face face(VertexHandle a, VertexHandle b, VertexHandle c) const;
    Face& at(FaceHandle f) { return faces_[static_cast<std::size_t>(f.idx())]; }
    void suspect(HalfedgeHandle h);
    double openness(const Face& one, HalfedgeHandle side);
    void flip_if_better(EdgeHandle e);

    HalfEdges& mesh_;
    std::span<const Vector3d> normals_;
    std::vector<Face> faces_;
    std::vector<EdgeHandle> suspects_;
};

/// A flip counts as an improvement only if it raises the rating by more than this, which is larger
/// than rounding errors.
constexpr double least_gain = 1e-9;
constexpr double upside_down = 0.05;  ///< A mean cosine below this counts as upside down.

/// Rates the fold at an edge between two triangles with these normals: 1 if they are at most at a
/// right angle to each other, 0 if the triangles are folded onto each other.
double openness_between(Vector3d one, Vector3d other) { return std::min(1.0, 1 + dot(one, other)); }

EdgeFlipper::EdgeFlipper(HalfEdges& mesh, std::span<const Vector3d> normals)
    : mesh_(mesh), normals_(normals), faces_(mesh.n_faces()) {
    for (const FaceHandle f : mesh.faces()) look_at(f);
}

/// Queues an edge, unless its tag says that it is queued already.
void EdgeFlipper::suspect(HalfedgeHandle h) {
    const EdgeHandle e = mesh_.edge_handle(h);
    if (mesh_.status(e).tagged()) return;
    mesh_.status(e).set_tagged(true);
    suspects_.push_back(e);
}

void EdgeFlipper::look_at(FaceHandle f) {
    if (mesh_.status(f).deleted()) return;
    const HalfedgeHandle h = mesh_.halfedge_handle(f);
    at(f) = face(mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h), mesh_.opposite_vh(h));
    for (const HalfedgeHandle side :
         {h, mesh_.next_halfedge_handle(h), mesh_.prev_halfedge_handle(h)}) {
        suspect(side);
    }
}

void EdgeFlipper::improve(const std::atomic<bool>& cancel) {
    while (!suspects_.empty() && !cancel) {
        const EdgeHandle e = suspects_.back();
        suspects_.pop_back();
        mesh_.status(e).set_tagged(false);
        if (!mesh_.status(e).deleted() && !mesh_.is_boundary(e)) flip_if_better(e);
    }
}

EdgeFlipper::Face EdgeFlipper::face(VertexHandle a, VertexHandle b, VertexHandle c) const {
    const Vector3d at_a = position(mesh_, a), at_b = position(mesh_, b), at_c = position(mesh_, c);
    const TriangleQuality quality =
        quality_of({at_a, at_b, at_c},
                   {normals_[number(a)], normals_[number(b)], normals_[number(c)]});
    return {quality.score(), quality.mean_cosine > upside_down,
            unit(cross(at_b - at_a, at_c - at_a))};
}

/// The rating of the fold between a triangle and its neighbour across a side.
double EdgeFlipper::openness(const Face& one, HalfedgeHandle side) {
    const FaceHandle other = mesh_.opposite_face_handle(side);
    return other.is_valid() ? openness_between(one.direction, at(other).direction) : 1;
}

/// Flips an edge if that raises the lowest of its ratings; see EdgeFlipper.
void EdgeFlipper::flip_if_better(EdgeHandle e) {
    const HalfedgeHandle h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
    const VertexHandle c = mesh_.opposite_vh(h), d = mesh_.opposite_vh(o);
    if (c == d) return;
    const HalfedgeHandle bc = mesh_.next_halfedge_handle(h), ca = mesh_.prev_halfedge_handle(h);
    const HalfedgeHandle ad = mesh_.next_halfedge_handle(o), db = mesh_.prev_halfedge_handle(o);
    const Face &one = at(mesh_.face_handle(h)), &other = at(mesh_.face_handle(o));
    const double before =
        least_gain + std::min({one.score, other.score, openness(one, h), openness(one, bc),
                               openness(one, ca), openness(other, ad), openness(other, db)});
    const Face first = face(c, d, mesh_.to_vertex_handle(h));
    if (!first.is_upright || first.score <= before) return;
    const Face second = face(d, c, mesh_.from_vertex_handle(h));
    if (!second.is_upright || second.score <= before) return;
    const double folds =
        std::min({openness_between(first.direction, second.direction), openness(first, bc),
                  openness(first, db), openness(second, ca), openness(second, ad)});
    if (folds <= before || are_neighbours(mesh_, c, d)) return;
    mesh_.flip(e);
    at(mesh_.face_handle(bc)) = first;
    at(mesh_.face_handle(ca)) = second;
    for (const HalfedgeHandle side : {bc, ca, ad, db}) suspect(side);
}

constexpr int most_rounds = 16;  ///< The largest number of rounds that try again to remove points.

class Retiler {
public:
    Retiler(const SurfaceMesh& old, std::span<const SurfacePlace> places, HalfEdges& mesh,
            MutualTessellation made)
        : old_(old),
          places_(places),
          mesh_(mesh),
          made_(std::move(made)),
          removal_(mesh, made_.normals, spacing(old, places.size())),
          flipper_(mesh, made_.normals) {
        std::vector<bool> is_place(old.points.size());
        for (const std::uint32_t point : made_.point_of_place) {
            if (point < is_place.size()) is_place[point] = true;
        }
        for (std::uint32_t point = 0; point < is_place.size(); ++point) {
            if (!is_place[point]) left_.push_back({point, WhyKept::topology});
        }
    }

    Result<Retiled> retile(const std::atomic<bool>& cancel) {
        flipper_.improve(cancel);
        for (const Care care : {Care::high, Care::low}) {
            bool is_changed = true;
            for (int round = 0; round < most_rounds && is_changed && !left_.empty(); ++round) {
                is_changed = remove_all(care, cancel);
                if (is_changed) flipper_.improve(cancel);
            }
        }
        if (cancel) return failure("re-tiling the surface was stopped");
        return result();
    }

private:
    /// The typical distance between neighbouring positions: the side of a square whose area is the
    /// area of the mesh divided by the number of positions.
    static double spacing(const SurfaceMesh& mesh, std::size_t places) {
        return std::sqrt(mesh.total_area() / static_cast<double>(std::max<std::size_t>(places, 1)));
    }

    /// Tries to remove all points that are left. Returns whether any point was removed.
    bool remove_all(Care care, const std::atomic<bool>& cancel) {
        const std::size_t before = left_.size();
        std::erase_if(left_, [&](KeptPoint& kept) {
            if (cancel) return false;
            const std::optional<WhyKept> why = removal_.remove(kept.old_point, care);
            if (why) {
                kept.why = *why;
                return false;
            }
            for (const FaceHandle f : removal_.changed()) flipper_.look_at(f);
            return true;
        });
        return left_.size() < before;
    }

    Retiled result() const {
        std::vector<std::uint32_t> points = made_.point_of_place;
        for (const KeptPoint& kept : left_) points.push_back(kept.old_point);
        Retiled result{surface_mesh(mesh_, points), left_};
        for (const PointAttribute& attribute : old_.attributes) {
            result.mesh.attributes.push_back({attribute.name, carried(attribute.values)});
        }
        return result;
    }

    std::vector<float> carried(const std::vector<float>& of_points) const {
        std::vector<float> values;
        for (const SurfacePlace& place : places_) {
            double sum = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                sum += place.weights[k] * of_points[old_.triangles[place.triangle][k]];
            }
            values.push_back(static_cast<float>(sum));
        }
        for (const KeptPoint& kept : left_) values.push_back(of_points[kept.old_point]);
        return values;
    }

    const SurfaceMesh& old_;
    std::span<const SurfacePlace> places_;
    HalfEdges& mesh_;
    MutualTessellation made_;
    PointRemoval removal_;
    EdgeFlipper flipper_;
    std::vector<KeptPoint> left_;  ///< Old points that remain.
};

}  // namespace

Result<Retiled> retile(const SurfaceMesh& mesh, std::span<const SurfacePlace> places,
                       const std::atomic<bool>& cancel) {
    Result<HalfEdges> edited = half_edges(mesh);
    if (!edited) return tl::unexpected(edited.error());
    Result<MutualTessellation> made = tessellate(*edited, mesh, places, cancel);
    if (!made) return tl::unexpected(made.error());
    return Retiler(mesh, places, *edited, *std::move(made)).retile(cancel);
}

}  // namespace cascade
