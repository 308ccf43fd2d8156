// A front is where values cross the middle of their range. Each front is examined by four cells in
// a row, along every axis.
#include "run/simulation/thin_fronts.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace cascade {
namespace {

/// A front between two adjacent cells is thinner than a cell if two conditions hold. The values of
/// these cells differ by at least `least_jump_of_front` times the range. Each of the values differs
/// by at most `most_beside` times the range from the value of the next cell in the direction away
/// from the front.
constexpr double least_jump_of_front = 0.8, most_beside = 0.1;
/// If at least this fraction of all fronts is thin, almost all fronts count as thin.
constexpr double mostly_thin = 0.9;

class FrontSearch {
public:
    FrontSearch(const Field& values, const Field* rates, const Spread& spread)
        : values_(values),
          rates_(rates),
          range_(spread.largest - spread.smallest),
          middle_((spread.largest + spread.smallest) / 2) {}

    Fronts search() {
        const PlaneLayout& layout = values_.layout();
        const std::array<std::int64_t, 3> cells{layout.width, layout.height,
                                                layout.row_count() / layout.height};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Cell cell{};
            for (cell[2] = 0; cell[2] < cells[2]; ++cell[2]) {
                for (cell[1] = 0; cell[1] < cells[1]; ++cell[1]) {
                    for (cell[0] = 0; cell[0] < cells[0]; ++cell[0]) {
                        if (cell[axis] + 3 < cells[axis]) look_at(cell, axis);
                    }
                }
            }
        }
        return fronts_;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    static double at(const Field& field, Cell cell, std::size_t axis, std::int64_t further) {
        cell[axis] += further;
        return field.number_at(cell[0], cell[1], cell[2]);
    }

    void look_at(const Cell& cell, std::size_t axis) {
        const auto value = [&](std::int64_t n) { return at(values_, cell, axis, n); };
        const double b = value(1), c = value(2);
        if (!((b - middle_) * (c - middle_) < 0)) return;
        ++fronts_.all;
        const bool is_thin = std::abs(c - b) >= least_jump_of_front * range_ &&
                             std::abs(value(0) - b) <= most_beside * range_ &&
                             std::abs(value(3) - c) <= most_beside * range_;
        if (!is_thin) return;
        ++fronts_.thin;
        if (rates_ == nullptr) return;
        fronts_.speed +=
            (std::abs(at(*rates_, cell, axis, 1)) + std::abs(at(*rates_, cell, axis, 2))) / range_;
    }

    const Field& values_;
    const Field* rates_;
    double range_, middle_;
    Fronts fronts_;
};

}  // namespace

bool Fronts::are_thin() const { return all > 0 && thin >= mostly_thin * all; }

Fronts fronts_of(const Field& values, const Field* rates, const Spread& spread) {
    return FrontSearch(values, rates, spread).search();
}

}  // namespace cascade
