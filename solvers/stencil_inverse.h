// Preconditioning by the inverse of an operator with the same stencil in all cells of a grid.
#pragma once

#include "core/grid.h"
#include "core/parallel.h"
#include "core/plane.h"
#include "core/side.h"
#include "solvers/wave_transforms.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

/// Measures the mean stencil of a linear operator from its responses to single cells, and applies
/// the inverse of that stencil by fast Fourier transforms. Planes are given by the addresses of
/// their cells (0, 0, 0).
template <typename Number>
class StencilInverse {
public:
    /// Waves that the operator multiplies by less than this fraction of its largest factor are left
    /// out.
    static constexpr double least_factor = sizeof(Number) == sizeof(float) ? 1e-7 : 1e-14;

    /// `sides` are the rules at the field's sides. `areas` is null or a plane in which 0 marks
    /// cells outside the domain. `areas` must outlive the object. Throws std::bad_alloc.
    StencilInverse(const Grid& grid, const SideRules& sides, const Number* areas);

    /// Writes 1 into probed cells, which are far enough from each other and from sides.
    void put_probes(Number* plane) const;
    /// Averages the operator's responses to the probed cells, except for cells at the border of the
    /// domain.
    void learn(const Number* response);

    /// Whether the stored factors of all waves match the stencil.
    bool has_factors() const { return has_factors_; }
    /// Records that the stored factors match the stencil. One thread must call this after apply().
    void keep_factors() { has_factors_ = true; }
    /// Applies the inverse to a plane. The first `threads` threads of the team call this, each with
    /// its number and otherwise the same arguments. `knows_factors` is the result of has_factors()
    /// before the call, or true if the same threads have called apply() since then. The work is
    /// abandoned when `cancel`, which may be null, becomes true.
    void apply(Team& team, int thread, int threads, bool knows_factors, Number* plane,
               const std::atomic<bool>* cancel);

private:
    using Cosines = std::array<double, 4>;  ///< Cosines of 0 to 3 times an angle.

    std::int64_t cells_along(std::size_t axis) const;
    template <typename Act>
    void for_probes(const Act& act) const;
    Cosines cosines(int reach, Number difference) const;
    std::vector<double> weights_along(const WaveBlock<Number>& block, std::int64_t line) const;
    void find_factors(const WaveBlock<Number>& block, Number* factors) const;

    PlaneLayout layout_;
    double spacing_;
    const Number* areas_;
    WaveTransforms<Number> transforms_;
    std::array<int, 3> reach_{};
    std::vector<double> stencil_;  ///< The weights by offset, from −reach to reach along each axis.
    Plane<Number> factors_;        ///< The factors of the waves, block by block.
    bool has_factors_ = false;     ///< Whether `factors_` match the stencil.
};

extern template class StencilInverse<float>;
extern template class StencilInverse<double>;

}  // namespace cascade
