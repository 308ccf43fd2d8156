// Reduces a row to eight partial results, one for each vector lane, and then combines the partial
// results in pairs.
#include "ir/reduction.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace cascade {
namespace {

/// Partial result i is made from cells i, i + 8, i + 16, … of a row.
constexpr std::size_t partial_results = 8;

double take_together(ReductionKind kind, double a, double b) {
    switch (kind) {
        case ReductionKind::sum:
        case ReductionKind::mean: return a + b;
        case ReductionKind::least: return std::isnan(a) || a < b ? a : b;
        case ReductionKind::largest: return std::isnan(a) || a > b ? a : b;
    }
    return a;
}

/// Combines adjacent values in pairs until one value is left.
double fold_pairs(ReductionKind kind, std::span<double> values) {
    for (std::size_t count = values.size(); count > 1; count = (count + 1) / 2) {
        for (std::size_t k = 0; 2 * k < count; ++k) {
            values[k] = 2 * k + 1 < count ? take_together(kind, values[2 * k], values[2 * k + 1])
                                          : values[2 * k];
        }
    }
    return values[0];
}

template <typename Number, typename Take>
void take_row(std::span<double, partial_results> partial, const Number* cells, std::int64_t count,
              const Take& take) {
    const auto width = static_cast<std::int64_t>(partial_results);
    std::int64_t i = width;
    for (; i + width <= count; i += width) {
        for (std::size_t k = 0; k < partial_results; ++k) {
            partial[k] =
                take(partial[k], static_cast<double>(cells[i + static_cast<std::int64_t>(k)]));
        }
    }
    for (std::size_t k = 0; i < count; ++i, ++k) {
        partial[k] = take(partial[k], static_cast<double>(cells[i]));
    }
}

}  // namespace

template <typename Number>
double reduce_row(ReductionKind kind, const Number* cells, std::int64_t count) {
    std::array<double, partial_results> partial{};
    const auto start = static_cast<std::size_t>(count < static_cast<std::int64_t>(partial_results)
                                                    ? count
                                                    : static_cast<std::int64_t>(partial_results));
    for (std::size_t k = 0; k < start; ++k) partial[k] = static_cast<double>(cells[k]);
    if (kind == ReductionKind::sum || kind == ReductionKind::mean) {
        take_row(partial, cells, count, [](double a, double b) { return a + b; });
    } else {
        take_row(partial, cells, count,
                 [kind](double a, double b) { return take_together(kind, a, b); });
    }
    return fold_pairs(kind, std::span(partial).first(start));
}

template double reduce_row<float>(ReductionKind, const float*, std::int64_t);
template double reduce_row<double>(ReductionKind, const double*, std::int64_t);

double reduce_rows(ReductionKind kind, std::span<double> rows, std::int64_t cells) {
    const double all = fold_pairs(kind, rows);
    return kind == ReductionKind::mean ? all / static_cast<double>(cells) : all;
}

}  // namespace cascade
