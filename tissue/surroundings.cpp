// Implements the surroundings of surfaces and of boxes.
#include "tissue/surroundings.h"

#include "core/links.h"
#include "mesh/normals.h"
#include "surface/curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {
namespace {

NearPlace near_nothing(Vector3d point) {
    NearPlace near;
    near.position = point;
    if (!is_finite(point)) near.off = std::numeric_limits<double>::quiet_NaN();
    return near;
}

class AroundSurface : public Surroundings {
public:
    explicit AroundSurface(const SurfaceMesh& mesh)
        : mesh_(mesh),
          follower_(mesh),
          normals_(sphere_normals(mesh)),
          corner_normals_(mesh.triangles.size()) {
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            corner_normals_.data()[t] = {normals_[a], normals_[b], normals_[c]};
        }
        for (const auto& edges : mesh.across) {
            for (const TriangleEdge& edge : edges) is_open_ = is_open_ || !edge.exists();
        }
    }

    NearPlace near(Vector3d point, std::uint32_t triangle) const override {
        NearPlace near;
        near_few({&point, 1}, {&triangle, 1}, {&near, 1});
        return near;
    }
    void near_all(std::span<const Vector3d> points, std::span<const std::uint32_t> triangles,
                  std::span<NearPlace> result) const override {
        constexpr std::size_t most = PlaceFollower::AllOver::most;
        for (std::size_t first = 0; first < points.size(); first += most) {
            const std::size_t count = std::min(most, points.size() - first);
            near_few(points.subspan(first, count), triangles.subspan(first, count),
                     result.subspan(first, count));
        }
    }
    void prepare(std::uint32_t triangle) const override {
        if (triangle >= mesh_.triangles.size()) return;
        follower_.prepare(triangle);
        const auto* const normals = corner_normals_.data() + triangle;
        __builtin_prefetch(normals);
        __builtin_prefetch(reinterpret_cast<const char*>(normals + 1) - 1);
    }
    Vector3d held_inside(Vector3d point, const NearPlace& near) const override {
        return near.is_beyond ? near.position + near.normal * near.off : point;
    }
    bool holds() const override { return is_open_; }
    bool has_normal() const override { return true; }
    const SurfaceMesh* mesh() const override { return &mesh_; }
    Vector3d extent() const override {
        const SurfaceMesh::Box box = mesh_.box();
        return box.high - box.low;
    }

private:
    /// Finds the nearest position to a cell for which PlaceFollower::stay() finds nothing.
    NearPlace search(Vector3d point, std::uint32_t triangle) const {
        NearPlace near = near_nothing(point);
        near.place.triangle = triangle;
        const auto found = follower_.find(point, triangle);
        if (!found) return near;
        near.place = found->place;
        near.position = found->position;
        near.normal = normal_of(near.place.triangle, near.place.weights);
        near.is_beyond = found->is_border;
        const double height = dot(point - near.position, near.normal);
        near.off = near.is_beyond ? height : std::copysign(found->distance, height);
        return near;
    }
    /// Finds the nearest positions for several cells, at most as many as PlaceFollower::AllOver
    /// holds.
    void near_few(std::span<const Vector3d> points, std::span<const std::uint32_t> triangles,
                  std::span<NearPlace> result) const {
        using AllOver = PlaceFollower::AllOver;
        AllOver over;
        follower_.stay(points, triangles, over);
        std::array<std::array<AllOver::Numbers, 3>, 3> corners;  // By component.
        for (std::size_t k = 0; k < AllOver::most; ++k) {
            const std::array<Vector3d, 3>& normals = corner_normals_.data()[over.triangles[k]];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                corners[0][corner][k] = normals[corner].x;
                corners[1][corner][k] = normals[corner].y;
                corners[2][corner][k] = normals[corner].z;
            }
        }
        std::array<AllOver::Numbers, 3> normal;
        AllOver::Numbers squares;
        for (std::size_t k = 0; k < AllOver::most; ++k) {
            std::array<double, 3> sum;
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] = corners[c][0][k] * over.weights[0][k] +
                         corners[c][1][k] * over.weights[1][k] +
                         corners[c][2][k] * over.weights[2][k];
            }
            squares[k] = sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2];
            const double inverse = 1 / std::sqrt(squares[k]);
            for (std::size_t c = 0; c < 3; ++c) normal[c][k] = sum[c] * inverse;
        }
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (!over.is_over[k] || !(squares[k] > 0)) {
                result[k] = search(points[k], triangles[k]);
                continue;
            }
            NearPlace& near = result[k];
            near.place = {over.triangles[k],
                          {over.weights[0][k], over.weights[1][k], over.weights[2][k]}};
            near.position =
                points[k] - Vector3d{over.normals[0][k], over.normals[1][k], over.normals[2][k]} *
                                over.heights[k];
            near.normal = {normal[0][k], normal[1][k], normal[2][k]};
            near.off = std::copysign(over.heights[k], dot(points[k] - near.position, near.normal));
            near.is_beyond = false;
        }
    }
    /// Does the same as normal_at(), but reads the corners' normals from one array, where they are
    /// adjacent.
    Vector3d normal_of(std::uint32_t triangle, const std::array<double, 3>& weights) const {
        const auto& [a, b, c] = corner_normals_.data()[triangle];
        const Vector3d sum = a * weights[0] + b * weights[1] + c * weights[2];
        return dot(sum, sum) > 0 ? unit(sum) : normal_at(mesh_, normals_, {triangle, weights});
    }

    const SurfaceMesh& mesh_;
    PlaceFollower follower_;
    std::vector<Vector3d> normals_;                         ///< By point.
    AlignedArray<std::array<Vector3d, 3>> corner_normals_;  ///< By triangle and corner.
    bool is_open_ = false;
};

double held(double at, double extent, bool is_periodic) {
    if (extent <= 0 || (at >= 0 && at < extent)) return at;
    if (!is_periodic) return std::clamp(at, 0.0, extent);
    const double within = at - extent * std::floor(at / extent);
    return within < extent ? within : 0;
}

class InBox : public Surroundings {
public:
    InBox(Vector3d extent, std::array<bool, 3> is_periodic)
        : extent_(extent), is_periodic_(is_periodic) {}

    NearPlace near(Vector3d point, std::uint32_t) const override {
        NearPlace near = near_nothing(point);
        if (extent_.z > 0 || !is_finite(point)) return near;
        near.position.z = 0;
        near.off = point.z;
        return near;
    }
    Vector3d held_inside(Vector3d point, const NearPlace&) const override {
        return {held(point.x, extent_.x, is_periodic_[0]),
                held(point.y, extent_.y, is_periodic_[1]),
                held(point.z, extent_.z, is_periodic_[2])};
    }
    bool holds() const override { return true; }
    bool has_normal() const override { return extent_.z == 0; }
    std::array<double, 3> period() const override {
        return {is_periodic_[0] ? extent_.x : 0, is_periodic_[1] ? extent_.y : 0,
                is_periodic_[2] ? extent_.z : 0};
    }
    Vector3d extent() const override { return extent_; }

private:
    Vector3d extent_;
    std::array<bool, 3> is_periodic_;
};

}  // namespace

std::unique_ptr<Surroundings> around_surface(const SurfaceMesh& mesh) {
    return std::make_unique<AroundSurface>(mesh);
}

std::unique_ptr<Surroundings> in_box(Vector3d extent, std::array<bool, 3> is_periodic) {
    return std::make_unique<InBox>(extent, is_periodic);
}

}  // namespace cascade
