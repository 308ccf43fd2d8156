// Directions in tangent planes as complex numbers, which can be added, transported and smoothed.
#pragma once

#include "surface/direction_field.h"

#include <cmath>

namespace cascade {

/// Directions count as cancelled out if the length of their sum is less than this fraction of the
/// sum of their lengths.
constexpr double cancelled_part = 1e-6;

/// Directions as codes: vectors in the frames of their planes. The code of a line has twice the
/// line's angle, so that v and −v have the same code, and perpendicular lines cancel out.
class CodedDirections {
public:
    CodedDirections(const TangentPlanes& planes, DirectionKind kind)
        : planes_(planes), kind_(kind) {}

    /// The code of a vector. The code has the vector's length.
    Vector2d of(std::size_t plane, Vector3d v) const {
        const Vector2d flat = planes_.frames[plane].in_plane(v);
        if (kind_ == DirectionKind::arrows) return flat;
        return product(flat, unit_of(flat));
    }
    /// The direction that a code stands for, with length 1.
    Vector3d in_space(std::size_t plane, Vector2d code) const {
        const double angle = std::atan2(code.y, code.x) / symmetry();
        return planes_.frames[plane].in_space({std::cos(angle), std::sin(angle)});
    }
    /// The factor, of length 1, that transports a neighbour's code into this plane.
    Vector2d turn(const TangentLink& link) const {
        const double angle = link.turn * symmetry();
        return {std::cos(angle), std::sin(angle)};
    }

    std::vector<Vector3d> in_space(const std::vector<Vector2d>& codes) const {
        std::vector<Vector3d> field;
        field.reserve(codes.size());
        for (std::size_t k = 0; k < codes.size(); ++k) field.push_back(in_space(k, codes[k]));
        return field;
    }

private:
    double symmetry() const { return kind_ == DirectionKind::lines ? 2 : 1; }

    const TangentPlanes& planes_;
    DirectionKind kind_;
};

}  // namespace cascade
