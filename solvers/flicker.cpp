// Values that jump back and forth from step to step.
#include "solvers/flicker.h"

#include "solvers/field_norms.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cascade {
namespace {

/// A change that dies out becomes smaller by more than this part.
constexpr double lasting = 0.95;

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
            for (std::int64_t i = 0; i < layout.width; ++i) {
                if (inside_ != nullptr && inside_->row(row)[i] == 0) continue;
                ++seen.cells;
                const double middle = b.row(row)[i];
                const double first = middle - a.row(row)[i], second = c.row(row)[i] - middle;
                const bool is_undone =
                    first * second < 0 && std::abs(first) >= least && std::abs(second) >= least;
                if (is_undone) ++seen.undone;
                std::uint8_t& steady = seen.steady.row(row)[i];
                steady = (is_first || steady != 0) && is_undone &&
                         std::abs(second) >= lasting * std::abs(first);
                if (steady == 0) continue;
                ++seen.flickering;
                seen.largest = std::max(seen.largest, std::abs(second));
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
