// The chequerboard mode of a field.
#include "solvers/stability.h"

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

template <typename Number>
double chequerboard_of(const Plane<Number>& field, const Mask* inside) {
    const PlaneLayout& layout = field.layout();
    if (field.empty()) return 0;
    // Calls visit(value, column + row + slice) for every cell that counts.
    const auto for_each_cell = [&](const auto& visit) {
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            const std::int64_t jk = row % layout.height + row / layout.height;
            for (std::int64_t i = 0; i < layout.width; ++i) {
                if (inside == nullptr || inside->row(row)[i] != 0) visit(field.row(row)[i], i + jk);
            }
        }
    };

    // Two passes: sums of squares of values far from 0 would lose the deviations.
    double sum = 0, cells = 0;
    for_each_cell([&](double value, std::int64_t) {
        sum += value;
        ++cells;
    });
    if (cells < 1) return 0;
    const double mean = sum / cells;
    double alternating = 0, squares = 0, largest = 0;
    for_each_cell([&](double value, std::int64_t place) {
        const double deviation = value - mean;
        alternating += place % 2 == 0 ? deviation : -deviation;
        squares += deviation * deviation;
        largest = std::max(largest, std::abs(deviation));
    });
    // Deviations of a rounding are no pattern.
    if (!(largest > 1e-6 * std::abs(mean))) return 0;
    return std::abs(alternating) / cells / std::sqrt(squares / cells);
}

}  // namespace

double chequerboard(const Field& field, const Mask* inside) {
    return field.visit([&](const auto& plane) { return chequerboard_of(plane, inside); });
}

}  // namespace cascade
