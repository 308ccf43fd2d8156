// Computes norms and moments of fields.
#include "solvers/field_norms.h"

#include "core/wide_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace cascade {
namespace {

/// Sums value(i) for i in [0, count): first sixteen partial sums, which compilers can hold in
/// vectors, then the total of these.
template <typename Value>
[[gnu::always_inline]] inline double sum(std::int64_t count, Value value) {
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

/// A row of a field, or of the difference of two fields.
template <typename Number>
struct Row {
    const Number* cells;
    const Number* subtracted;  ///< May be null.
    /// Only cells where this is not 0 count. If null, all cells count.
    const std::uint8_t* counts;
    std::int64_t width;

    /// Calls `use(value, counts)` with two functions of a cell's index: the cell's value, and
    /// whether the cell counts. The kind of row is tested here, outside of loops.
    template <typename Use>
    [[gnu::always_inline]] auto visit(Use use) const {
        const auto with_counts = [&](auto value) __attribute__((always_inline)) {
            if (counts == nullptr) return use(value, [](std::int64_t) { return true; });
            return use(value, [this](std::int64_t i) { return counts[i] != 0; });
        };
        if (subtracted == nullptr) {
            return with_counts([this](std::int64_t i) { return double{cells[i]}; });
        }
        return with_counts([this](std::int64_t i) { return double{cells[i]} - subtracted[i]; });
    }
};

template <typename Number>
[[gnu::always_inline]] inline double sum_of(const Row<Number>& row) {
    return row.visit([&](auto value, auto counts) __attribute__((always_inline)) {
        return sum(row.width, [&](std::int64_t i) { return counts(i) ? value(i) : 0.0; });
    });
}
WITH_WIDE_VECTORS double row_sum(const Row<float>& row) { return sum_of(row); }
WITH_WIDE_VECTORS double row_sum(const Row<double>& row) { return sum_of(row); }

template <typename Number>
[[gnu::always_inline]] inline double squares_of(const Row<Number>& row, double mean) {
    return row.visit([&](auto value, auto counts) __attribute__((always_inline)) {
        return sum(row.width, [&](std::int64_t i) {
            const double apart = value(i) - mean;
            return counts(i) ? apart * apart : 0.0;
        });
    });
}
WITH_WIDE_VECTORS double squares_about(const Row<float>& row, double mean) {
    return squares_of(row, mean);
}
WITH_WIDE_VECTORS double squares_about(const Row<double>& row, double mean) {
    return squares_of(row, mean);
}

/// The root of the mean of (value − mean)² over all cells. `row_at(row)` gives each Row.
template <typename RowAt>
double root_mean_square_about(double mean, const PlaneLayout& layout, RowAt row_at) {
    double squares = 0, cells = 0;
    for (std::int64_t number = 0; number < layout.row_count(); ++number) {
        const auto row = row_at(number);
        squares += squares_about(row, mean);
        cells += static_cast<double>(cells_that_count(row.counts, row.width));
    }
    return std::sqrt(squares / cells);
}

template <typename RowAt>
FieldMoments moments_of(const PlaneLayout& layout, RowAt row_at) {
    double values = 0, cells = 0;
    for (std::int64_t number = 0; number < layout.row_count(); ++number) {
        const auto row = row_at(number);
        values += row_sum(row);
        cells += static_cast<double>(cells_that_count(row.counts, row.width));
    }
    FieldMoments result;
    result.mean = values / cells;
    result.root_mean_square = root_mean_square_about(0, layout, row_at);
    // Sums squares about the mean, because a difference of squares would lose a pattern of small
    // amplitude.
    result.deviation = root_mean_square_about(result.mean, layout, row_at);
    return result;
}

template <typename Number>
auto rows_in(const Plane<Number>& plane, const Plane<Number>* subtracted, const Mask* inside) {
    return [&plane, subtracted, inside](std::int64_t row) {
        return Row<Number>{plane.row(row), subtracted ? subtracted->row(row) : nullptr,
                           inside ? inside->row(row) : nullptr, plane.layout().width};
    };
}

WITH_WIDE_VECTORS double sum_of_squares(const float* cells, std::int64_t count) {
    return sum(count, [cells](std::int64_t i) { return double{cells[i]} * cells[i]; });
}
WITH_WIDE_VECTORS double sum_of_squares(const double* cells, std::int64_t count) {
    return sum(count, [cells](std::int64_t i) { return cells[i] * cells[i]; });
}

}  // namespace

std::int64_t cells_that_count(const std::uint8_t* counts, std::int64_t width) {
    if (counts == nullptr) return width;
    return width - std::count(counts, counts + width, std::uint8_t{0});
}

FieldMoments moments(const Field& field, const Mask* inside) {
    return field.visit(
        [&](const auto& plane) { return moments_of(plane.layout(), rows_in(plane, {}, inside)); });
}

FieldMoments moments_of_difference(const Field& a, const Field& b, const Mask* inside) {
    return with_number(a.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const auto& plane = a.plane<Number>();
        return moments_of(plane.layout(), rows_in(plane, &b.plane<Number>(), inside));
    });
}

double root_mean_square(const Field& field, const Mask* inside) {
    return field.visit([&](const auto& plane) {
        return root_mean_square_about(0, plane.layout(), rows_in(plane, {}, inside));
    });
}

double root_mean_square_of_difference(const Field& a, const Field& b, const Mask* inside) {
    return with_number(a.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const auto& plane = a.plane<Number>();
        return root_mean_square_about(0, plane.layout(),
                                      rows_in(plane, &b.plane<Number>(), inside));
    });
}

double sum_of_squares(const Field& field, std::int64_t row, std::int64_t cells) {
    return field.visit([&](const auto& plane) {
        const std::int64_t width = plane.layout().width;
        const auto* const values = plane.row(row);
        if (cells >= width) return sum_of_squares(values, width);
        // Adds zeros for the cells beyond `cells`, so that numbers are added in the order of a
        // whole row.
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
