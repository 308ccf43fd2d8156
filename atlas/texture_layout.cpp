// Rasterises triangles by edge functions. A fill rule for points on edges, as in GPUs, ensures that
// two triangles with a common edge never share a sample.
#include "atlas/texture_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cascade {

namespace {

/// Positive if `point` is to the left of the line from a to b. Swapping a and b negates the result
/// exactly.
double side_of(Vector2d a, Vector2d b, Vector2d point) {
    if (b.x < a.x || (b.x == a.x && b.y < a.y)) return -cross(a - b, point - b);
    return cross(b - a, point - a);
}

/// The index of a sample, wrapped into the repeating texture.
std::int64_t wrapped(std::int64_t number, std::int64_t size) {
    const std::int64_t rest = number % size;
    return rest < 0 ? rest + size : rest;
}

std::int64_t divided_down(std::int64_t number, std::int64_t size) {
    return (number - wrapped(number, size)) / size;
}

/// The first sample whose centre is not below `low`, and the last whose centre is not above `high`.
std::int64_t first_from(double low) { return static_cast<std::int64_t>(std::ceil(low - 0.5)); }
std::int64_t last_to(double high) { return static_cast<std::int64_t>(std::floor(high - 0.5)); }

Vector2d middle_of(std::int64_t column, std::int64_t row) {
    return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
}

}  // namespace

TextureLayout::TextureLayout(const SurfaceMesh& mesh, std::int64_t width, std::int64_t height)
    : width_(width), height_(height), triangles_(mesh.texture.size()) {
    double area = 0, mirrored = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        Drawn& drawn = triangles_[t];
        bool has_places = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const TexturePlace& place = mesh.texture[t][k];
            for (const float number : place) {
                has_places = has_places && std::abs(number) <= largest_place;
            }
            drawn.corners[k] = {static_cast<double>(place[0]) * static_cast<double>(width),
                                (1 - static_cast<double>(place[1])) * static_cast<double>(height)};
        }
        if (!has_places) {
            ++skipped_.without_place;
            continue;
        }
        const auto& [a, b, c] = drawn.corners;
        const double twice = side_of(a, b, c);
        if (twice == 0) {
            ++skipped_.without_area;
            continue;
        }
        drawn.sign = twice > 0 ? 1 : -1;
        drawn.first = first_from(std::min({a.y, b.y, c.y}));
        drawn.last = last_to(std::max({a.y, b.y, c.y}));
        drawn.top = divided_down(drawn.first, height_);
        drawn.bottom = divided_down(drawn.last, height_);
        drawn.left = divided_down(first_from(std::min({a.x, b.x, c.x})), width_);
        drawn.right = divided_down(last_to(std::max({a.x, b.x, c.x})), width_);
        repeats_ =
            repeats_ || drawn.top != 0 || drawn.bottom != 0 || drawn.left != 0 || drawn.right != 0;
        area += std::abs(twice) / 2;
        // Rows go down in the texture, so a mirrored triangle has a positive area.
        if (twice > 0) mirrored += twice / 2;
    }
    const double all = static_cast<double>(width) * static_cast<double>(height);
    covered_area_ = area / all;
    mirrored_area_ = mirrored / all;
}

bool TextureLayout::holds(const Drawn& triangle, Vector2d point, std::array<double, 3>& inside) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
        inside[k] = triangle.sign * side_of(a, b, point);
        if (inside[k] > 0) continue;
        // A point on an edge is treated as if it were slightly to the right and, by even less,
        // below.
        const Vector2d along = (b - a) * triangle.sign;
        const bool has_edge = along.y < 0 || (along.y == 0 && along.x > 0);
        if (inside[k] < 0 || !has_edge) return false;
    }
    return true;
}

template <typename Visit>
void TextureLayout::visit_columns(const Drawn& triangle, std::int64_t row, const Visit& visit) {
    const double y = static_cast<double>(row) + 0.5;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
        if ((a.y <= y) == (b.y <= y)) continue;
        const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        low = std::min(low, x);
        high = std::max(high, x);
    }
    if (!(low <= high)) return;
    // The loop includes one more sample at either end, as a margin for rounding.
    std::array<double, 3> inside{};
    for (std::int64_t column = first_from(low) - 1; column <= last_to(high) + 1; ++column) {
        if (holds(triangle, middle_of(column, row), inside)) visit(column);
    }
}

TextureLayout::Overlap TextureLayout::find_owners(std::int64_t first, std::int64_t last,
                                                  std::span<std::uint32_t> owners) const {
    std::fill(owners.begin(), owners.end(), nothing);
    Overlap overlap;
    constexpr std::uint32_t shared_mark = 0x80000000;  // No triangle has a number as large as this.
    const auto share = [&](std::uint32_t& owner) {
        ++overlap.again;
        overlap.shared += (owner & shared_mark) == 0;
        owner |= shared_mark;
    };
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        const Drawn& triangle = triangles_[t];
        if (triangle.sign == 0) continue;
        for (std::int64_t turn = triangle.top * height_; turn <= triangle.last; turn += height_) {
            const std::int64_t begin = std::max(triangle.first, turn + first);
            const std::int64_t end = std::min(triangle.last + 1, turn + last);
            for (std::int64_t row = begin; row < end; ++row) {
                const std::int64_t line = (row - turn - first) * width_;
                visit_columns(triangle, row, [&](std::int64_t column) {
                    std::uint32_t& owner =
                        owners[static_cast<std::size_t>(line + wrapped(column, width_))];
                    if (owner == nothing) owner = t;
                    else share(owner);
                });
            }
        }
    }
    if (overlap.shared > 0) {
        for (std::uint32_t& owner : owners) {
            if (owner != nothing) owner &= ~shared_mark;
        }
    }
    return overlap;
}

SurfacePlace TextureLayout::place_at(std::uint32_t triangle, std::int64_t column,
                                     std::int64_t row) const {
    const Drawn& drawn = triangles_[triangle];
    SurfacePlace place{triangle, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    std::array<double, 3> inside{};
    for (std::int64_t turn = drawn.top; turn <= drawn.bottom; ++turn) {
        for (std::int64_t across = drawn.left; across <= drawn.right; ++across) {
            const Vector2d point = middle_of(column + across * width_, row + turn * height_);
            if (!holds(drawn, point, inside)) continue;
            const double sum = inside[0] + inside[1] + inside[2];
            if (!(sum > 0)) continue;
            // The weight of a corner is proportional to the distance from the opposite edge.
            place.weights = {inside[1] / sum, inside[2] / sum, inside[0] / sum};
            return place;
        }
    }
    return place;
}

}  // namespace cascade
