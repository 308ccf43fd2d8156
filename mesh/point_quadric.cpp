// Sums of squares as symmetric matrices, vectors and constants.
#include "mesh/point_quadric.h"

namespace cascade {

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

}  // namespace cascade
