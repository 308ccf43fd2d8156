// Forces are computed side by side and summed one after the other, so that the sum does not depend
// on the width of vectors.
#include "surface/repulsion.h"

#include "core/hash.h"
#include "core/wide_vectors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

constexpr float core_strength = 4;
/// Places at a smaller squared distance, in radii, coincide.
constexpr float least_square = 1e-14F;

/// The direction in which a place is pushed apart from one that coincides with it.
Vector2f own_direction(std::uint32_t number) {
    const double angle = 2 * std::numbers::pi / 4294967296.0 * pcg4d({number, 0, 0, 0})[0];
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

/// Replaces the movements of `count` neighbours from `first` on by their forces on a place. A
/// neighbour that coincides with the place pushes in the direction `apart`. Returns the number of
/// those.
WITH_WIDE_VECTORS std::uint32_t find_forces(const NeighbourList& neighbours, std::size_t first,
                                            std::size_t count, const Repulsion::Pushed place,
                                            Vector2f apart, float* __restrict by_x,
                                            float* __restrict by_y) {
    const float* __restrict stood_x = neighbours.stood_x.data() + first;
    const float* __restrict stood_y = neighbours.stood_y.data() + first;
    const float* __restrict turn_x = neighbours.turn_x.data() + first;
    const float* __restrict turn_y = neighbours.turn_y.data() + first;
    std::uint32_t coincident = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const float x = stood_x[n] + turn_x[n] * by_x[n] - turn_y[n] * by_y[n] - place.moved.x;
        const float y = stood_y[n] + turn_y[n] * by_x[n] + turn_x[n] * by_y[n] - place.moved.y;
        const float u = place.xx * x + place.xy * y, v = place.xy * x + place.yy * y;
        const float square = u * u + v * v, distance = std::sqrt(square);
        const float closer = repulsion_core - distance;
        const float size = 1 - distance + core_strength * (closer > 0 ? closer : 0);
        const float away_x = square < least_square ? apart.x : -u / distance;
        const float away_y = square < least_square ? apart.y : -v / distance;
        by_x[n] = square < 1 ? away_x * size : 0;
        by_y[n] = square < 1 ? away_y * size : 0;
        coincident += square < least_square ? 1 : 0;
    }
    return coincident;
}

}  // namespace

void NeighbourList::add(std::uint32_t number, Vector2d stood, Vector2d turn) {
    if (size_ + together >= numbers.size()) {
        const std::size_t room = 2 * size_ + 2 * together;
        numbers.resize(room);
        for (std::vector<float>* values : {&stood_x, &stood_y, &turn_x, &turn_y})
            values->resize(room);
    }
    numbers[size_] = number;
    stood_x[size_] = static_cast<float>(stood.x);
    stood_y[size_] = static_cast<float>(stood.y);
    turn_x[size_] = static_cast<float>(turn.x);
    turn_y[size_] = static_cast<float>(turn.y);
    ++size_;
}

Vector2f Repulsion::push_on(const Pushed& place, const NeighbourList& neighbours, std::size_t first,
                            std::size_t end, const std::vector<Vector2f>& moved) {
    // Those after the last neighbour, of the next place, only fill the last vector.
    constexpr std::size_t together = NeighbourList::together;
    const std::size_t count = end - first, filled = (count + together - 1) / together * together;
    if (x_.size() < filled) {
        x_.resize(filled);
        y_.resize(filled);
    }
    const auto find = [&](Vector2f apart) {
        for (std::size_t n = 0; n < count; ++n) {
            const Vector2f by = moved[neighbours.numbers[first + n]];
            x_[n] = by.x;
            y_[n] = by.y;
        }
        return find_forces(neighbours, first, filled, place, apart, x_.data(), y_.data());
    };
    if (find({}) > 0) find(own_direction(place.number));
    Vector2f push;
    for (std::size_t n = 0; n < count; ++n) {
        push.x += x_[n];
        push.y += y_[n];
    }
    return push;
}

}  // namespace cascade
