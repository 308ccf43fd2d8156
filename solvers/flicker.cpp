// Detects values that jump back and forth from step to step.
#include "solvers/flicker.h"

#include "core/wide_vectors.h"
#include "solvers/field_norms.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cascade {
namespace {

/// A change whose size is below this fraction of the previous change is dying out.
constexpr double lasting = 0.95;

/// The changes of a row of cells in two steps.
template <typename Number>
struct Changes {
    const Number *before, *between, *after;

    double first(std::int64_t i) const { return double{between[i]} - before[i]; }
    double second(std::int64_t i) const { return double{after[i]} - between[i]; }
    /// Whether both changes are at least `least` in size and have opposite signs.
    bool is_undone(std::int64_t i, double least) const {
        const double one = first(i), other = second(i);
        return one * other < 0 && std::abs(one) >= least && std::abs(other) >= least;
    }
};

template <typename Number>
[[gnu::always_inline]] inline std::int64_t count_undone(const Changes<Number>& changes,
                                                        std::int64_t width, double least) {
    std::int64_t count = 0;
    for (std::int64_t i = 0; i < width; ++i) count += changes.is_undone(i, least) ? 1 : 0;
    return count;
}
WITH_WIDE_VECTORS std::int64_t undone_in(const Changes<float>& changes, std::int64_t width,
                                         double least) {
    return count_undone(changes, width, least);
}
WITH_WIDE_VECTORS std::int64_t undone_in(const Changes<double>& changes, std::int64_t width,
                                         double least) {
    return count_undone(changes, width, least);
}

}  // namespace

void FlickerWatch::see(std::span<const Field> species) {
    seen_.resize(species.size());
    for (std::size_t k = 0; k < species.size(); ++k) {
        Species& seen = seen_[k];
        if (!seen.before_last.empty()) compare(seen, species[k]);
        seen.before_last = std::move(seen.last);
        seen.last = species[k].clone();
    }
}

void FlickerWatch::compare(Species& seen, const Field& now) const {
    const FieldMoments size = moments(now, inside_);
    const double least = std::max(0.1 * size.deviation, 1e-3 * size.root_mean_square);
    const PlaneLayout& layout = now.layout();
    const bool is_first = seen.steady.empty();
    if (is_first) seen.steady = Mask(layout);
    seen.cells = seen.flickering = 0;
    ++seen.comparisons;
    with_number(now.precision(), [&](auto zero) {
        using Number = decltype(zero);
        const auto &a = seen.before_last.plane<Number>(), &b = seen.last.plane<Number>(),
                   &c = now.plane<Number>();
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            const Changes<Number> changes{a.row(row), b.row(row), c.row(row)};
            const std::uint8_t* const counts = inside_ != nullptr ? inside_->row(row) : nullptr;
            std::uint8_t* const steady = seen.steady.row(row);
            seen.cells += static_cast<double>(cells_that_count(counts, layout.width));
            // A quick test. In most runs, most rows have no undone change.
            if (undone_in(changes, layout.width, least) == 0) {
                std::fill_n(steady, layout.width, std::uint8_t{0});
                continue;
            }
            for (std::int64_t i = 0; i < layout.width; ++i) {
                if (counts != nullptr && counts[i] == 0) continue;
                const bool is_undone = changes.is_undone(i, least);
                if (is_undone) ++seen.undone;
                const double first = std::abs(changes.first(i));
                const double second = std::abs(changes.second(i));
                steady[i] = (is_first || steady[i] != 0) && is_undone && second >= lasting * first;
                if (steady[i] == 0) continue;
                ++seen.flickering;
                seen.largest = std::max(seen.largest, second);
            }
        }
    });
}

FlickerWatch::Finding FlickerWatch::finding(std::size_t species) const {
    if (species >= seen_.size() || seen_[species].comparisons == 0 || seen_[species].cells == 0)
        return {};
    const Species& seen = seen_[species];
    return {seen.flickering / seen.cells, seen.undone / (seen.cells * seen.comparisons),
            seen.largest};
}

}  // namespace cascade
