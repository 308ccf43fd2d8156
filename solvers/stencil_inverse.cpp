// The symbol of the stencil is a sum of products of cosines, one for each axis.
#include "solvers/stencil_inverse.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace cascade {
namespace {

/// The distance between probes of the stencil, in cells. Stencils reach at most three cells.
constexpr std::int64_t between_probes = 7;

}  // namespace

template <typename Number>
StencilInverse<Number>::StencilInverse(const Grid& grid, const SideRules& sides,
                                       const Number* areas)
    : layout_(grid),
      spacing_(grid.spacing),
      areas_(areas),
      transforms_(grid, std::vector<SideRules>{sides}),
      factors_(layout_) {
    std::size_t offsets = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        reach_[axis] = static_cast<int>(std::min<std::int64_t>(3, (cells_along(axis) - 1) / 2));
        offsets *= static_cast<std::size_t>(2 * reach_[axis] + 1);
    }
    stencil_.resize(offsets);
}

template <typename Number>
std::int64_t StencilInverse<Number>::cells_along(std::size_t axis) const {
    return axis == 0 ? layout_.width : axis == 1 ? layout_.height : layout_.depth;
}

/// Calls `act(x, y, z)` for each probed cell.
template <typename Number>
template <typename Act>
void StencilInverse<Number>::for_probes(const Act& act) const {
    std::array<std::int64_t, 3> first{}, count{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t cells = cells_along(axis);
        first[axis] = reach_[axis];
        count[axis] = cells == 1 ? 1 : std::max<std::int64_t>(1, cells / between_probes);
    }
    for (std::int64_t z = 0; z < count[2]; ++z) {
        for (std::int64_t y = 0; y < count[1]; ++y) {
            for (std::int64_t x = 0; x < count[0]; ++x) {
                act(first[0] + between_probes * x, first[1] + between_probes * y,
                    first[2] + between_probes * z);
            }
        }
    }
}

template <typename Number>
void StencilInverse<Number>::put_probes(Number* plane) const {
    for_probes([&](std::int64_t x, std::int64_t y, std::int64_t z) {
        plane[layout_.offset(x, y, z) - layout_.offset(0, 0, 0)] = Number{1};
    });
}

template <typename Number>
void StencilInverse<Number>::learn(const Number* response) {
    const std::vector<double> before = stencil_;
    std::fill(stencil_.begin(), stencil_.end(), 0.0);
    double probes = 0;
    std::vector<double> one(stencil_.size());
    for_probes([&](std::int64_t x, std::int64_t y, std::int64_t z) {
        std::size_t n = 0;
        bool is_whole = true;
        for (int dz = -reach_[2]; dz <= reach_[2]; ++dz) {
            for (int dy = -reach_[1]; dy <= reach_[1]; ++dy) {
                const std::int64_t row =
                    layout_.offset(x, y + dy, z + dz) - layout_.offset(0, 0, 0);
                for (int dx = -reach_[0]; dx <= reach_[0]; ++dx) {
                    one[n++] = static_cast<double>(response[row + dx]);
                    is_whole = is_whole && (areas_ == nullptr || areas_[row + dx] != 0);
                }
            }
        }
        if (!is_whole) return;
        for (std::size_t k = 0; k < one.size(); ++k) stencil_[k] += one[k];
        ++probes;
    });
    for (double& weight : stencil_) weight /= std::max(probes, 1.0);
    if (probes == 0) stencil_[stencil_.size() / 2] = 1;
    has_factors_ = has_factors_ && stencil_ == before;
}

/// Writes to `factors`, by line and wave, the reciprocal of the stencil's symbol for each wave of a
/// block.
template <typename Number>
void StencilInverse<Number>::find_factors(const WaveBlock<Number>& block, Number* factors) const {
    double size = 0;
    for (const double weight : stencil_) size += std::abs(weight);
    const double least = size * least_factor;
    const std::size_t axis = block.axis;
    for (std::int64_t line = 0; line < block.lines; ++line) {
        const std::vector<double> along = weights_along(block, line);
        for (std::int64_t wave = 0; wave < block.count; ++wave) {
            const auto by = cosines(reach_[axis], block.differences[axis][wave]);
            double factor = 0;
            for (std::size_t k = 0; k < along.size(); ++k) factor += along[k] * by[k];
            const double inverse = std::abs(factor) <= least ? 0 : 1 / (factor * block.gain);
            factors[line * block.count + wave] = static_cast<Number>(inverse);
        }
    }
}

/// The stencil's weights by distance along the block's axis, at least 0. Weights across the axis
/// are multiplied by cosines of the waves of a line, and summed. Weights at equal distances are
/// added.
template <typename Number>
std::vector<double> StencilInverse<Number>::weights_along(const WaveBlock<Number>& block,
                                                          std::int64_t line) const {
    const std::size_t axis = block.axis;
    std::array<Cosines, 3> across{};
    for (std::size_t other = 0; other < 3; ++other) {
        if (other == axis) continue;
        across[other] = cosines(reach_[other], block.differences[other][other == 0 ? line : 0]);
    }
    std::vector<double> along(static_cast<std::size_t>(reach_[axis]) + 1, 0);
    std::size_t n = 0;
    for (int dz = -reach_[2]; dz <= reach_[2]; ++dz) {
        for (int dy = -reach_[1]; dy <= reach_[1]; ++dy) {
            for (int dx = -reach_[0]; dx <= reach_[0]; ++dx) {
                const std::array<std::size_t, 3> offset{static_cast<std::size_t>(std::abs(dx)),
                                                        static_cast<std::size_t>(std::abs(dy)),
                                                        static_cast<std::size_t>(std::abs(dz))};
                double weight = stencil_[n++];
                for (std::size_t other = 0; other < 3; ++other) {
                    if (other != axis) weight *= across[other][offset[other]];
                }
                along[offset[axis]] += weight;
            }
        }
    }
    return along;
}

/// The cosines of multiples of a wave's phase from cell to cell, up to the stencil's reach.
/// `difference` is the factor by which the second difference multiplies the wave.
template <typename Number>
auto StencilInverse<Number>::cosines(int reach, Number difference) const -> Cosines {
    Cosines values{1, 1 + static_cast<double>(difference) * spacing_ * spacing_ / 2, 0, 0};
    for (int n = 2; n <= reach; ++n) {
        const auto k = static_cast<std::size_t>(n);
        values[k] = 2 * values[1] * values[k - 1] - values[k - 2];
    }
    return values;
}

template <typename Number>
void StencilInverse<Number>::apply(Team& team, int thread, int threads, bool knows_factors,
                                   Number* plane, const std::atomic<bool>* cancel) {
    Number* const all_factors = factors_.origin();
    const auto divide = [&](const WaveBlock<Number>& block) {
        Number* const factors = all_factors + block.offset;
        if (!knows_factors) find_factors(block, factors);
        const std::int64_t count = block.lines * block.count;
        for (std::int64_t n = 0; n < count; ++n) {
            if (block.is_complex) {
                block.waves[0][2 * n] *= factors[n];
                block.waves[0][2 * n + 1] *= factors[n];
            } else {
                block.waves[0][n] *= factors[n];
            }
        }
    };
    Number* const planes[] = {plane};
    const std::span<Number* const> list(planes);
    transforms_.apply(team, thread, threads, {true}, {&list, 1}, divide, cancel);
}

template class StencilInverse<float>;
template class StencilInverse<double>;

}  // namespace cascade
