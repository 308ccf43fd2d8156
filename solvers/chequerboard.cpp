// The chequerboard mode of a field.
#include "solvers/stability.h"

#include <algorithm>
#include <cmath>

namespace cascade {

double chequerboard(const Field& field) {
    const PlaneLayout& layout = field.layout();
    const auto cells = static_cast<double>(layout.width * layout.row_count());
    if (field.empty() || cells < 1) return 0;

    // Two passes: sums of squares of values far from 0 would lose the deviations.
    double sum = 0;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < layout.width; ++i) sum += field.row(row)[i];
    }
    const double mean = sum / cells;
    double alternating = 0, squares = 0, largest = 0;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        const std::int64_t jk = row % layout.height + row / layout.height;
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const double deviation = field.row(row)[i] - mean;
            alternating += (i + jk) % 2 == 0 ? deviation : -deviation;
            squares += deviation * deviation;
            largest = std::max(largest, std::abs(deviation));
        }
    }
    // Deviations of a rounding are no pattern.
    if (!(largest > 1e-6 * std::abs(mean))) return 0;
    return std::abs(alternating) / cells / std::sqrt(squares / cells);
}

}  // namespace cascade
