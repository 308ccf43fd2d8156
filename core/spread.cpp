// Statistics of adjacent values, in vectors, and merging of two sets of values.
#include "core/spread.h"

#include "core/wide_vectors.h"

#include <array>
#include <cstddef>

namespace cascade {
namespace {

/// Values that compilers keep in a few vectors.
constexpr std::size_t lanes = 16;

/// Of a multiple of `lanes` values, at least one. The sum is not finite if one of them is not.
template <typename Number>
[[gnu::always_inline]] inline Spread spread_of_finite(std::span<const Number> values) {
    std::array<double, lanes> sums{}, squares{};
    std::array<Number, lanes> smallest, largest;
    for (std::size_t lane = 0; lane < lanes; ++lane) smallest[lane] = largest[lane] = values[0];
    for (std::size_t k = 0; k < values.size(); k += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Number value = values[k + lane];
            sums[lane] += value;
            smallest[lane] = value < smallest[lane] ? value : smallest[lane];
            largest[lane] = value > largest[lane] ? value : largest[lane];
        }
    }
    Spread spread;
    spread.count = static_cast<double>(values.size());
    for (const double sum : sums) spread.mean += sum;
    spread.mean /= spread.count;
    for (std::size_t k = 0; k < values.size(); k += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const double apart = values[k + lane] - spread.mean;
            squares[lane] += apart * apart;
        }
    }
    for (const double square : squares) spread.squares += square;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        spread.smallest = std::min(spread.smallest, double{smallest[lane]});
        spread.largest = std::max(spread.largest, double{largest[lane]});
    }
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

/// Those that count, one stretch after another.
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
