// Norms and moments of fields.
#include "solvers/field_norms.h"

#include "core/wide_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace cascade {
namespace {

/// Sums value(i) for i of [0, count): sixteen partial sums, which a compiler can keep in vectors,
/// then those one by one.
template <typename Value>
inline double sum(std::int64_t count, Value value) {
    constexpr std::int64_t lanes = 16;
    std::array<double, lanes> sums{};
    std::int64_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        for (std::int64_t lane = 0; lane < lanes; ++lane) {
            sums[static_cast<std::size_t>(lane)] += value(i + lane);
        }
    }
    for (; i < count; ++i) sums[0] += value(i);
    double total = 0;
    for (const double each : sums) total += each;
    return total;
}

template <typename ValueOfRow>
double mean_over_cells(const PlaneLayout& layout, const Mask* inside, ValueOfRow value_of_row) {
    double total = 0, cells = 0;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        const auto value = value_of_row(row);
        if (inside == nullptr) {
            total += sum(layout.width, value);
            cells += static_cast<double>(layout.width);
            continue;
        }
        const std::uint8_t* counts = inside->row(row);
        total += sum(layout.width, [&](std::int64_t i) { return counts[i] ? value(i) : 0.0; });
        cells += sum(layout.width, [&](std::int64_t i) { return counts[i] ? 1.0 : 0.0; });
    }
    return total / cells;
}

/// `value_of_row(row)` is a function of the cell in it.
template <typename ValueOfRow>
FieldMoments moments_of(const PlaneLayout& layout, const Mask* inside, ValueOfRow value_of_row) {
    FieldMoments result;
    result.mean = mean_over_cells(layout, inside, value_of_row);
    result.root_mean_square = std::sqrt(mean_over_cells(layout, inside, [&](std::int64_t row) {
        return [value = value_of_row(row)](std::int64_t i) { return value(i) * value(i); };
    }));
    // About the mean, because the difference of two squares would lose a pattern of small
    // amplitude.
    result.deviation = std::sqrt(mean_over_cells(layout, inside, [&](std::int64_t row) {
        return [value = value_of_row(row), mean = result.mean](std::int64_t i) {
            const double apart = value(i) - mean;
            return apart * apart;
        };
    }));
    return result;
}

WITH_WIDE_VECTORS double sum_of_squares(const float* cells, std::int64_t count) {
    return sum(count, [cells](std::int64_t i) { return double{cells[i]} * cells[i]; });
}
WITH_WIDE_VECTORS double sum_of_squares(const double* cells, std::int64_t count) {
    return sum(count, [cells](std::int64_t i) { return cells[i] * cells[i]; });
}

}  // namespace

FieldMoments moments(const Field& field, const Mask* inside) {
    return field.visit([&](const auto& plane) {
        return moments_of(plane.layout(), inside, [&](std::int64_t row) {
            return [cells = plane.row(row)](std::int64_t i) { return double{cells[i]}; };
        });
    });
}

FieldMoments moments_of_difference(const Field& a, const Field& b, const Mask* inside) {
    return with_number(a.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const Plane<Number>&first = a.plane<Number>(), &second = b.plane<Number>();
        return moments_of(first.layout(), inside, [&](std::int64_t row) {
            return [p = first.row(row), q = second.row(row)](std::int64_t i) {
                return double{p[i]} - q[i];
            };
        });
    });
}

double root_mean_square(const Field& field, const Mask* inside) {
    return field.visit([&](const auto& plane) {
        return std::sqrt(mean_over_cells(plane.layout(), inside, [&](std::int64_t row) {
            return [cells = plane.row(row)](std::int64_t i) { return double{cells[i]} * cells[i]; };
        }));
    });
}

double sum_of_squares(const Field& field, std::int64_t row, std::int64_t cells) {
    return field.visit([&](const auto& plane) {
        const std::int64_t width = plane.layout().width;
        const auto* const values = plane.row(row);
        if (cells >= width) return sum_of_squares(values, width);
        // In the same order as in a whole row.
        return sum(width,
                   [&](std::int64_t i) { return i < cells ? double{values[i]} * values[i] : 0.0; });
    });
}

double root_mean_square(std::span<const double> sums_of_squares, std::int64_t cells) {
    double total = 0;
    for (const double each : sums_of_squares) total += each;
    return std::sqrt(total / static_cast<double>(cells));
}

}  // namespace cascade
