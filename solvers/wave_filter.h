// Filters planes wave by wave: the heart of solvers that take diffusion implicitly.
//
// On a grid whose sides are periodic, or let nothing or a given amount through, or hold a value,
// the discrete Laplacian has waves for eigenvectors: sines and cosines along each axis, whose phase
// the sides decide. A change of a species obeys the same rules at the sides without their values:
// where the species is held it is 0, where its flux is given nothing flows. So each plane is taken
// apart into waves by FFTW, each wave multiplied, and the waves put together again.
#pragma once

#include "core/parallel.h"
#include "core/side.h"
#include "ir/diffusion.h"
#include "ir/sweep_form.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cascade {

/// The diffusion of one species. A wave for which lap is s and dxx, dyy, dzz are s_x, s_y, s_z (all
/// of them 0 or less) changes at the rate
///     M = min(0, f[0] s − f[1] s² + f[2] s³ − f[3] s⁴ + f[4] s_x + f[5] s_y + f[6] s_z).
/// So waves that the factors would make grow are left to the rest of the step.
using DiffusionSymbol = DiffusionTerms<double>;

template <typename Number>
class WaveFilter {
public:
    /// `sides` are those of each species. Throws std::bad_alloc.
    WaveFilter(const Grid& grid, const std::vector<SideRules>& sides);
    WaveFilter(WaveFilter&&) noexcept;
    ~WaveFilter();

    /// Multiplies every wave of every plane, given by the addresses of their cells (0, 0, 0), one
    /// for each species. `length` is the h of the response. Called by the first `threads` threads
    /// of the team, each with its number and the same arguments; rows as of split_rows() are read
    /// before the first meeting of the team and written after the last, by their own thread. Bits
    /// do not depend on `threads`.
    void apply(Team& team, int thread, int threads, std::span<Number* const> planes,
               std::span<const DiffusionSymbol> symbols, WaveResponse response,
               double length) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

extern template class WaveFilter<float>;
extern template class WaveFilter<double>;

}  // namespace cascade
