// Ear clipping in the coordinate plane nearest to the polygon. Quadrilaterals are a special case.
#include "mesh/triangulate.h"

#include "core/vector2.h"
#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

constexpr double most_work = 4e9;  ///< The largest number of tests whether a corner lies in an ear.

using Triangle = std::array<std::uint32_t, 3>;

/// Twice the signed area of a triangle.
double turn(Vector2d a, Vector2d b, Vector2d c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A normal of the polygon, whose length is twice the polygon's area: the sum over a fan of
/// triangles.
Vector3d normal_of(std::span<const Vector3d> corners) {
    Vector3d sum;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        sum = sum + cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
    }
    return sum;
}

/// The polygon projected along the axis nearest to its normal, counterclockwise.
std::vector<Vector2d> flattened(std::span<const Vector3d> corners) {
    const Vector3d n = normal_of(corners);
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    std::vector<Vector2d> flat;
    flat.reserve(corners.size());
    for (const Vector3d& c : corners) {
        const Vector3d p = c - corners[0];
        if (x >= y && x >= z) flat.push_back({p.y, n.x < 0 ? -p.z : p.z});
        else if (y >= z) flat.push_back({p.z, n.y < 0 ? -p.x : p.x});
        else flat.push_back({p.x, n.z < 0 ? -p.y : p.y});
    }
    return flat;
}

void cut_quadrilateral(std::span<const Vector3d> c, std::vector<Triangle>& triangles) {
    const Vector3d n = normal_of(c);
    const auto fits = [&](std::size_t a, std::size_t b, std::size_t d) {
        return dot(cross(c[b] - c[a], c[d] - c[a]), n) > 0;
    };
    const bool first_fits = fits(0, 1, 2) && fits(0, 2, 3);
    const bool second_fits = fits(1, 2, 3) && fits(1, 3, 0);
    const bool first_is_shorter = length(c[2] - c[0]) <= length(c[3] - c[1]);
    if (first_fits != second_fits ? first_fits : first_is_shorter) {
        triangles.push_back({0, 1, 2});
        triangles.push_back({0, 2, 3});
    } else {
        triangles.push_back({1, 2, 3});
        triangles.push_back({1, 3, 0});
    }
}

/// The corners of a polygon that remain while ears are cut off, as a ring.
class Ring {
public:
    explicit Ring(std::vector<Vector2d> corners) : corners_(std::move(corners)) {
        const auto count = static_cast<std::uint32_t>(corners_.size());
        for (std::uint32_t k = 0; k < count; ++k) {
            next_.push_back((k + 1) % count);
            previous_.push_back((k + count - 1) % count);
        }
        for (std::uint32_t k = 0; k < count; ++k) {
            if (!is_convex(k)) dents_.push_back(k);
        }
    }

    std::size_t dents() const { return dents_.size(); }
    std::uint32_t next(std::uint32_t k) const { return next_[k]; }
    Triangle ear(std::uint32_t k) const { return {previous_[k], k, next_[k]}; }

    /// Whether corner k is convex and no other corner is inside its ear. Only reflex corners need
    /// to be tested.
    bool is_ear(std::uint32_t k) const {
        if (!is_convex(k)) return false;
        const auto [a, b, c] = ear(k);
        return std::none_of(dents_.begin(), dents_.end(), [&](std::uint32_t dent) {
            if (dent == a || dent == b || dent == c) return false;
            const Vector2d p = corners_[dent];
            return turn(corners_[a], corners_[b], p) >= 0 &&
                   turn(corners_[b], corners_[c], p) >= 0 && turn(corners_[c], corners_[a], p) >= 0;
        });
    }

    void cut(std::uint32_t k) {
        const std::uint32_t before = previous_[k], after = next_[k];
        next_[before] = after;
        previous_[after] = before;
        std::erase_if(dents_, [&](std::uint32_t dent) {
            return dent == k || ((dent == before || dent == after) && is_convex(dent));
        });
    }

private:
    bool is_convex(std::uint32_t k) const {
        return turn(corners_[previous_[k]], corners_[k], corners_[next_[k]]) > 0;
    }

    std::vector<Vector2d> corners_;
    std::vector<std::uint32_t> next_, previous_, dents_;
};

}  // namespace

bool triangulate(std::span<const Vector3d> corners, std::vector<Triangle>& triangles) {
    const std::size_t count = corners.size();
    if (count < 3) return true;
    if (count == 3) {
        triangles.push_back({0, 1, 2});
        return true;
    }
    if (count == 4) {
        cut_quadrilateral(corners, triangles);
        return true;
    }
    Ring ring(flattened(corners));
    const auto size = static_cast<double>(count);
    if (size * size * static_cast<double>(ring.dents()) > most_work) return false;
    std::uint32_t at = 0;
    for (std::size_t left = count; left > 3; --left) {
        std::size_t tried = 0;
        while (tried < left && !ring.is_ear(at)) {
            at = ring.next(at);
            ++tried;
        }
        // If the polygon intersects itself, this may be any corner.
        triangles.push_back(ring.ear(at));
        const std::uint32_t following = ring.next(at);
        ring.cut(at);
        at = ring.next(following);  // Skipping a corner avoids fans in round polygons.
    }
    triangles.push_back(ring.ear(at));
    return true;
}

}  // namespace cascade
