// A module of OpenMesh's decimater that computes the cost of each collapse and refuses some
// collapses.
#include "mesh/simplify.h"

#include "core/check.h"
#include "core/vector3.h"
#include "mesh/collapse_edges.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>

namespace cascade {

namespace {

// The error of a point, in its position and its attributes, after it has replaced other points.

/// A function of a point and its attributes: a sum over triangles, weighted by area. A triangle's
/// term is the squared distance of the point from the triangle's plane, plus the squared
/// differences between the point's attributes and the linear functions that interpolate the
/// attributes on the triangle (H. Hoppe, "New Quadric Metric for Simplifying Meshes with Appearance
/// Attributes", IEEE Visualization 1999).
class PointQuadric {
public:
    static constexpr std::size_t most_attributes = 3;
    using Attributes = std::array<double, most_attributes>;

    /// Adds a plane through `at`, with a unit normal.
    void add_plane(double weight, Vector3d at, Vector3d normal);
    /// Adds a triangle, whose area must not be 0. `values` are the attributes of its corners.
    void add_triangle(const std::array<Vector3d, 3>& corners,
                      const std::array<Attributes, 3>& values, std::size_t attributes);
    PointQuadric& operator+=(const PointQuadric& other);

    /// The error of a point at this position. Rounding may make the error slightly negative.
    double error(Vector3d point, const Attributes& values, std::size_t attributes) const;
    /// The area of all triangles added so far.
    double area() const { return area_; }

private:
    /// Adds weight (slope · p + constant)².
    void add_square(double weight, Vector3d slope, double constant);

    std::array<double, 6> squares_{};  ///< xx, xy, xz, yy, yz, zz.
    Vector3d linear_;
    double constant_ = 0, area_ = 0;
    std::array<Vector3d, most_attributes> slopes_{};  ///< The sums of area · gradient.
    Attributes offsets_{};
};

void PointQuadric::add_square(double weight, Vector3d slope, double constant) {
    const Vector3d s = slope * weight;
    squares_[0] += s.x * slope.x;
    squares_[1] += s.x * slope.y;
    squares_[2] += s.x * slope.z;
    squares_[3] += s.y * slope.y;
    squares_[4] += s.y * slope.z;
    squares_[5] += s.z * slope.z;
    linear_ = linear_ + s * constant;
    constant_ += weight * constant * constant;
}

void PointQuadric::add_plane(double weight, Vector3d at, Vector3d normal) {
    add_square(weight, normal, -dot(normal, at));
}

void PointQuadric::add_triangle(const std::array<Vector3d, 3>& corners,
                                const std::array<Attributes, 3>& values, std::size_t attributes) {
    const Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0];
    const Vector3d normal = cross(u, v);
    const double square = dot(normal, normal), area = length(normal) / 2;
    add_plane(area, corners[0], normal * (1 / (2 * area)));
    area_ += area;
    for (std::size_t k = 0; k < attributes; ++k) {
        // The gradient g along the triangle: g · u and g · v are the differences.
        const double first = values[0][k];
        const Vector3d slope = (cross(v, normal) * (values[1][k] - first) +
                                cross(normal, u) * (values[2][k] - first)) *
                               (1 / square);
        const double constant = first - dot(slope, corners[0]);
        add_square(area, slope, constant);
        slopes_[k] = slopes_[k] + slope * area;
        offsets_[k] += constant * area;
    }
}

PointQuadric& PointQuadric::operator+=(const PointQuadric& other) {
    for (std::size_t k = 0; k < squares_.size(); ++k) squares_[k] += other.squares_[k];
    linear_ = linear_ + other.linear_;
    constant_ += other.constant_;
    area_ += other.area_;
    for (std::size_t k = 0; k < most_attributes; ++k) {
        slopes_[k] = slopes_[k] + other.slopes_[k];
        offsets_[k] += other.offsets_[k];
    }
    return *this;
}

double PointQuadric::error(Vector3d p, const Attributes& values, std::size_t attributes) const {
    double sum = constant_ + 2 * dot(linear_, p) + squares_[0] * p.x * p.x +
                 squares_[3] * p.y * p.y + squares_[5] * p.z * p.z +
                 2 * (squares_[1] * p.x * p.y + squares_[2] * p.x * p.z + squares_[4] * p.y * p.z);
    for (std::size_t k = 0; k < attributes; ++k) {
        sum += values[k] * (area_ * values[k] - 2 * (dot(slopes_[k], p) + offsets_[k]));
    }
    return sum;
}

using OpenMesh::Decimater::ModBaseT;
using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdges>;

constexpr unsigned most_edges_of_merged = 12;
/// The weight of an edge's length in the cost of its collapse. Where no collapse changes anything,
/// such as in a flat part of one colour, the length makes short edges collapse first.
constexpr double weight_of_length = 1e-5;
/// The weight of squared distances from the planes through boundary edges. The weight of distances
/// from the triangles' planes is 1.
constexpr double weight_of_boundary = 4;

/// The priority of a collapse is the error of the merged point. Lengths are relative to the
/// surface's box, so that priorities fit into OpenMesh's `float`.
class PatternModule : public ModBaseT<HalfEdges> {
public:
    using Handle = OpenMesh::Decimater::ModHandleT<PatternModule>;

    explicit PatternModule(HalfEdges& mesh) : ModBaseT(mesh, false) {}
    const std::string& name() const override {
        static const std::string name = "Pattern";
        return name;
    }

    void keep(const SurfaceMesh& surface, const KeptPattern& pattern) {
        const SurfaceMesh::Box box = surface.box();
        middle_ = (box.low + box.high) * 0.5;
        scale_ = 1 / length(box.high - box.low);
        attributes_ = pattern.values.empty() ? 0 : PointQuadric::most_attributes;
        const double weight = pattern.length * scale_;
        values_.resize(pattern.values.size());
        for (std::size_t p = 0; p < values_.size(); ++p) {
            for (std::size_t k = 0; k < attributes_; ++k) {
                const auto value = static_cast<double>(pattern.values[p][k]);
                values_[p][k] = std::isfinite(value) ? value * weight : 0;
            }
        }
    }

    void initialize() override {
        quadrics_.assign(mesh().n_vertices(), {});
        into_.resize(mesh().n_vertices());
        std::iota(into_.begin(), into_.end(), std::uint32_t{0});
        for (const FaceHandle f : mesh().faces()) add_face(f);
        for (const HalfedgeHandle h : mesh().halfedges()) {
            if (mesh().is_boundary(h)) add_boundary(h);
        }
    }

    float collapse_priority(const CollapseInfo& collapse) override {
        PointQuadric sum = quadrics_[number(collapse.v0)];
        const double own_area = sum.area();
        sum += quadrics_[number(collapse.v1)];
        const Vector3d to = place(collapse.v1), way = to - place(collapse.v0);
        const double error = std::max(0.0, sum.error(to, values_of(collapse.v1), attributes_));
        const auto cost = static_cast<float>(error + weight_of_length * own_area * dot(way, way));
        // The decimater requests the costs of all edges of a vertex in turn and takes the cheapest.
        // An edge that costs more than an already allowed edge of the vertex needs no further test.
        if (collapse.v0 == asked_ && cost >= cheapest_) return cost;
        if (!is_allowed(collapse)) return ILLEGAL_COLLAPSE;
        asked_ = collapse.v0;
        return cheapest_ = cost;
    }

    void postprocess_collapse(const CollapseInfo& collapse) override {
        quadrics_[number(collapse.v1)] += quadrics_[number(collapse.v0)];
        into_[number(collapse.v0)] = number(collapse.v1);
        asked_ = VertexHandle();
    }

    /// The surviving vertex for each vertex.
    std::vector<std::uint32_t> left() const { return ends_of_chains(into_); }

private:
    Vector3d place(VertexHandle v) { return (position(mesh(), v) - middle_) * scale_; }
    PointQuadric::Attributes values_of(VertexHandle v) const {
        return attributes_ == 0 ? PointQuadric::Attributes{} : values_[number(v)];
    }

    void add_face(FaceHandle f) {
        std::array<VertexHandle, 3> corners;
        std::array<Vector3d, 3> places;
        std::array<PointQuadric::Attributes, 3> values;
        HalfedgeHandle h = mesh().halfedge_handle(f);
        for (std::size_t k = 0; k < 3; ++k, h = mesh().next_halfedge_handle(h)) {
            corners[k] = mesh().from_vertex_handle(h);
            places[k] = place(corners[k]);
            values[k] = values_of(corners[k]);
        }
        const Vector3d normal = cross(places[1] - places[0], places[2] - places[0]);
        if (!(dot(normal, normal) > std::numeric_limits<double>::min())) return;
        PointQuadric quadric;
        quadric.add_triangle(places, values, attributes_);
        for (const VertexHandle v : corners) quadrics_[number(v)] += quadric;
    }

    /// Adds the plane through a boundary edge, perpendicular to the edge's triangle.
    void add_boundary(HalfedgeHandle h) {
        const HalfedgeHandle inside = mesh().opposite_halfedge_handle(h);
        const VertexHandle from = mesh().from_vertex_handle(inside),
                           to = mesh().to_vertex_handle(inside);
        const Vector3d at = place(from), along = place(to) - at;
        const Vector3d normal = cross(along, place(mesh().opposite_vh(inside)) - at);
        const Vector3d side = cross(along, normal);
        if (!(dot(side, side) > std::numeric_limits<double>::min())) return;
        PointQuadric quadric;
        quadric.add_plane(weight_of_boundary * dot(along, along), at, unit(side));
        for (const VertexHandle v : {from, to}) quadrics_[number(v)] += quadric;
    }

    /// Whether the vertex opposite a collapsed edge keeps enough triangles. If it had only three
    /// triangles, two coinciding ones would remain.
    bool keeps_triangles(VertexHandle across) {
        return !across.is_valid() ||
               mesh().valence(across) > (mesh().is_boundary(across) ? 2U : 3U);
    }

    bool is_allowed(const CollapseInfo& collapse) {
        if (!keeps_triangles(collapse.vl) || !keeps_triangles(collapse.vr)) return false;
        if (mesh().valence(collapse.v0) + mesh().valence(collapse.v1) > most_edges_of_merged + 4) {
            return false;
        }
        return keep_shape(mesh(), collapse.v0, collapse.v1, position(mesh(), collapse.v1),
                          std::numeric_limits<double>::infinity());
    }

    Vector3d middle_;
    double scale_ = 1;
    std::size_t attributes_ = 0;
    std::vector<PointQuadric::Attributes> values_;
    std::vector<PointQuadric> quadrics_;
    VertexHandle asked_;               ///< The vertex of the last collapse that was allowed.
    float cheapest_ = 0;               ///< The cost of the last collapse that was allowed.
    std::vector<std::uint32_t> into_;  ///< The vertex into which each vertex has merged.
};

class StopWhenCancelled : public OpenMesh::Decimater::Observer {
public:
    explicit StopWhenCancelled(const std::atomic<bool>& cancel) : Observer(1000), cancel_(cancel) {}
    void notify(std::size_t) override {}
    bool abort() const override { return cancel_; }

private:
    const std::atomic<bool>& cancel_;
};

}  // namespace

Result<Simplified> simplify(const SurfaceMesh& mesh, std::size_t triangles,
                            const KeptPattern& pattern, const std::atomic<bool>& cancel) {
    CHECK(pattern.values.empty() || pattern.values.size() == mesh.points.size(),
          "a pattern has values at each point");
    Result<HalfEdges> edited = half_edges(mesh);
    if (!edited) return tl::unexpected(edited.error());
    Simplified result;
    {
        Decimater decimater(*edited);
        PatternModule::Handle module;
        decimater.add(module);
        decimater.module(module).keep(mesh, pattern);
        StopWhenCancelled observer(cancel);
        decimater.set_observer(&observer);
        const bool is_ready = decimater.initialize();
        CHECK(is_ready, "the decimater has one module that says what a collapse costs");
        decimater.decimate_to_faces(0, std::max(triangles, std::size_t{1}));
        result.merged = decimater.module(module).left();
    }
    std::vector<std::uint32_t> indices(mesh.points.size());
    for (const VertexHandle v : edited->vertices()) {
        indices[number(v)] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(number(v));
    }
    for (std::uint32_t& point : result.merged) point = indices[point];
    result.mesh = surface_mesh(*edited, result.points);
    for (const PointAttribute& attribute : mesh.attributes) {
        PointAttribute& kept = result.mesh.attributes.emplace_back(attribute.without_values());
        for (const std::uint32_t point : result.points) {
            kept.values.push_back(attribute.values[point]);
        }
    }
    return result;
}

}  // namespace cascade
