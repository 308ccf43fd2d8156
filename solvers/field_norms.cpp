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

/// A row of a field, or of the difference of two.
template <typename Number>
struct Row {
    const Number* cells;
    const Number* subtracted;    ///< May be null.
    const std::uint8_t* counts;  ///< Cells count where it is not 0; null: all.
    std::int64_t width;

    /// Calls `use(value, counts)` with functions of the cell. The kinds of rows are told apart
    /// outside of the loops.
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

/// Of the cells of a row that count.
struct RowSums {
    double values = 0, squares = 0, cells = 0;
};

template <typename Number>
[[gnu::always_inline]] inline RowSums sums_of(const Row<Number>& row) {
    return row.visit([&](auto value, auto counts) __attribute__((always_inline)) {
        return RowSums{sum(row.width, [&](std::int64_t i) { return counts(i) ? value(i) : 0.0; }),
                       sum(row.width,
                           [&](std::int64_t i) { return counts(i) ? value(i) * value(i) : 0.0; }),
                       sum(row.width, [&](std::int64_t i) { return counts(i) ? 1.0 : 0.0; })};
    });
}
WITH_WIDE_VECTORS RowSums row_sums(const Row<float>& row) { return sums_of(row); }
WITH_WIDE_VECTORS RowSums row_sums(const Row<double>& row) { return sums_of(row); }

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

/// `row_at(row)` is a Row.
template <typename RowAt>
RowSums sums_of_rows(const PlaneLayout& layout, RowAt row_at) {
    RowSums total;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        const RowSums sums = row_sums(row_at(row));
        total.values += sums.values;
        total.squares += sums.squares;
        total.cells += sums.cells;
    }
    return total;
}

template <typename RowAt>
FieldMoments moments_of(const PlaneLayout& layout, RowAt row_at) {
    const RowSums sums = sums_of_rows(layout, row_at);
    FieldMoments result;
    result.mean = sums.values / sums.cells;
    result.root_mean_square = std::sqrt(sums.squares / sums.cells);
    // About the mean, because the difference of two squares would lose a pattern of small
    // amplitude.
    double squares = 0;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        squares += squares_about(row_at(row), result.mean);
    }
    result.deviation = std::sqrt(squares / sums.cells);
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
        const RowSums sums = sums_of_rows(plane.layout(), rows_in(plane, {}, inside));
        return std::sqrt(sums.squares / sums.cells);
    });
}

double root_mean_square_of_difference(const Field& a, const Field& b, const Mask* inside) {
    return with_number(a.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const auto& plane = a.plane<Number>();
        const RowSums sums =
            sums_of_rows(plane.layout(), rows_in(plane, &b.plane<Number>(), inside));
        return std::sqrt(sums.squares / sums.cells);
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
