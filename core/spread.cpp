// Vectorised statistics of adjacent values, and merging of two sets of values.
#include "core/spread.h"

#include "core/wide_vectors.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace cascade {
namespace {

/// The number of values that compilers can hold in a few vectors.
constexpr std::size_t lanes = 16;

/// Combines values lane by lane: `combine(so_far, value)`. Compilers vectorise one such loop, but
/// not a loop that does several things.
template <typename Result, typename Number, typename Combine>
[[gnu::always_inline]] inline std::array<Result, lanes> by_lanes(std::span<const Number> values,
                                                                 Result first, Combine combine) {
    std::array<Result, lanes> results;
    results.fill(first);
    for (std::size_t k = 0; k < values.size(); k += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            results[lane] = combine(results[lane], values[k + lane]);
        }
    }
    return results;
}

/// Finds the smallest and the largest of `values`. Their number is a positive multiple of `lanes`.
/// Compilers do not vectorise such loops by themselves.
template <typename Number>
[[gnu::always_inline]] inline void find_extremes(std::span<const Number> values, Spread& spread) {
    typedef Number Vector [[gnu::vector_size(lanes * sizeof(Number))]];
    Vector least, most, next;
    std::memcpy(&least, values.data(), sizeof least);
    most = least;
    for (std::size_t k = lanes; k < values.size(); k += lanes) {
        std::memcpy(&next, values.data() + k, sizeof next);
        least = next < least ? next : least;
        most = next > most ? next : most;
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        spread.smallest = std::min(spread.smallest, double{least[lane]});
        spread.largest = std::max(spread.largest, double{most[lane]});
    }
}

/// Statistics of values whose number is a positive multiple of `lanes`. The mean is not finite if
/// some value is not.
template <typename Number>
[[gnu::always_inline]] inline Spread spread_of_finite(std::span<const Number> values) {
    Spread spread;
    spread.count = static_cast<double>(values.size());
    const auto sums =
        by_lanes(values, 0.0, [](double sum, Number value) { return sum + double{value}; });
    for (const double sum : sums) spread.mean += sum;
    spread.mean /= spread.count;
    const auto squares = by_lanes(values, 0.0, [mean = spread.mean](double sum, Number value) {
        return sum + (double{value} - mean) * (double{value} - mean);
    });
    for (const double square : squares) spread.squares += square;
    find_extremes(values, spread);
    return spread;
}

WITH_WIDE_VECTORS Spread finite_spread(std::span<const float> values) {
    return spread_of_finite(values);
}
WITH_WIDE_VECTORS Spread finite_spread(std::span<const double> values) {
    return spread_of_finite(values);
}

template <typename Number>
Spread spread_of_each(std::span<const Number> values) {
    return spread_of([&](const auto& take) {
        for (const Number value : values) take(double{value});
    });
}

template <typename Number>
Spread spread_of_all(std::span<const Number> values) {
    const std::size_t together = values.size() / lanes * lanes;
    if (together == 0) return spread_of_each(values);
    Spread spread = finite_spread(values.first(together));
    if (!std::isfinite(spread.mean)) return spread_of_each(values);
    spread.add(spread_of_each(values.subspan(together)));
    return spread;
}

/// Statistics of the values where `counts` is not 0. Adds up the statistics of ranges of adjacent
/// values of this kind.
template <typename Number>
Spread spread_of_some(std::span<const Number> values, const std::uint8_t* counts) {
    if (counts == nullptr) return spread_of_all(values);
    Spread spread;
    for (std::size_t begin = 0; begin < values.size();) {
        std::size_t end = begin;
        while (end < values.size() && counts[end] != 0) ++end;
        if (end > begin) spread.add(spread_of_all(values.subspan(begin, end - begin)));
        begin = end + 1;
    }
    return spread;
}

}  // namespace

Spread spread_of(std::span<const float> values, const std::uint8_t* counts) {
    return spread_of_some(values, counts);
}
Spread spread_of(std::span<const double> values, const std::uint8_t* counts) {
    return spread_of_some(values, counts);
}

void Spread::add(const Spread& other) {
    if (other.count == 0) return;
    if (count == 0) {
        *this = other;
        return;
    }
    const double total = count + other.count;
    const double apart = other.mean - mean;
    squares += other.squares + apart * apart * (count * other.count / total);
    mean += apart * (other.count / total);
    count = total;
    smallest = std::min(smallest, other.smallest);
    largest = std::max(largest, other.largest);
}

}  // namespace cascade
