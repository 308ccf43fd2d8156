// The inverse of an operator on a grid that has the same stencil in all cells, as a preconditioner.
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

/// Learns the mean stencil of a linear operator from its responses to single cells, and applies the
/// inverse of that stencil by fast Fourier transforms. Planes are given by the addresses of their
/// cells (0, 0, 0).
template <typename Number>
class StencilInverse {
public:
    /// Waves are left out if the operator multiplies them by less than this fraction of its
    /// largest possible factor.
    static constexpr double least_factor = sizeof(Number) == sizeof(float) ? 1e-7 : 1e-14;

    /// `sides` are those of the field. `areas` is null or a plane of which the cells that are 0 are
    /// outside of the domain; it must outlive the object. Throws std::bad_alloc.
    StencilInverse(const Grid& grid, const SideRules& sides, const Number* areas);

    /// Puts 1 into cells that are far enough from each other and from sides; others keep what they
    /// have.
    void put_probes(Number* plane) const;
    /// Takes the mean of the operator's responses to these cells, less those at the border of the
    /// domain.
    void learn(const Number* response);

    /// Are the factors of all waves those of the stencil?
    bool has_factors() const { return has_factors_; }
    /// To be called by one thread after apply().
    void keep_factors() { has_factors_ = true; }
    /// Applies the inverse to a plane. Called by the first `threads` threads of the team, each with
    /// its number and otherwise the same arguments. `knows_factors`: what has_factors() was before,
    /// or true if these threads have called this before since then.
    void apply(Team& team, int thread, int threads, bool knows_factors, Number* plane);

private:
    using Cosines = std::array<double, 4>;  ///< Of 0 to 3 times an angle.

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
    std::vector<double> stencil_;  ///< By offset, from −reach to reach along each axis.
    Plane<Number> factors_;        ///< By block of waves …
    bool has_factors_ = false;     ///< … if they are those of the stencil.
};

extern template class StencilInverse<float>;
extern template class StencilInverse<double>;

}  // namespace cascade
