// Orders cells by the numbers of their boxes along a Hilbert curve.
#include "bench/curve_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cascade::bench {
namespace {

constexpr int bits = 21;  // Bits per axis. Three axes fit into a key.

/// The position of a box along the curve.
std::uint64_t curve_key(std::array<std::uint32_t, 3> box) {
    // Undoes the rotations and reflections of each level, beginning with the coarsest.
    for (std::uint32_t bit = 1U << (bits - 1); bit > 1; bit >>= 1) {
        const std::uint32_t below = bit - 1;
        for (std::uint32_t& axis : box) {
            if ((axis & bit) != 0) {
                box[0] ^= below;
            } else {
                const std::uint32_t swapped = (box[0] ^ axis) & below;
                box[0] ^= swapped;
                axis ^= swapped;
            }
        }
    }
    // Octants are numbered by Gray code.
    box[1] ^= box[0];
    box[2] ^= box[1];
    std::uint32_t inverted = 0;
    for (std::uint32_t bit = 1U << (bits - 1); bit > 1; bit >>= 1) {
        if ((box[2] & bit) != 0) inverted ^= bit - 1;
    }
    std::uint64_t key = 0;
    for (int bit = bits - 1; bit >= 0; --bit) {
        for (const std::uint32_t axis : box) key = key << 1 | (((axis ^ inverted) >> bit) & 1);
    }
    return key;
}

/// The cube of boxes around all positions.
class Cube {
public:
    explicit Cube(std::span<const Vector3d> positions) {
        Vector3d high{-infinity, -infinity, -infinity};
        for (const Vector3d& p : positions) {
            low_ = {std::fmin(low_.x, p.x), std::fmin(low_.y, p.y), std::fmin(low_.z, p.z)};
            high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
        }
        const Vector3d size = high - low_;
        scale_ = 1 / std::fmax(size.x, std::fmax(size.y, size.z));
    }

    std::array<std::uint32_t, 3> box_of(Vector3d p) const {
        return {part(p.x, low_.x), part(p.y, low_.y), part(p.z, low_.z)};
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr double last = (1U << bits) - 1;

    std::uint32_t part(double value, double low) const {
        const double place = (value - low) * scale_ * last;
        // NaN becomes 0. It comes from cells without a position and cubes without extent.
        return place > 0 ? static_cast<std::uint32_t>(std::fmin(place, last)) : 0;
    }

    Vector3d low_{infinity, infinity, infinity};
    double scale_ = 0;
};

}  // namespace

std::vector<std::uint32_t> order_along_curve(std::span<const Vector3d> positions) {
    const Cube cube(positions);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
    keys.reserve(positions.size());
    for (const Vector3d& position : positions) {
        keys.emplace_back(curve_key(cube.box_of(position)),
                          static_cast<std::uint32_t>(keys.size()));
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order;
    order.reserve(keys.size());
    for (const auto& [key, cell] : keys) order.push_back(cell);
    return order;
}

}  // namespace cascade::bench
