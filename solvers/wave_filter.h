// Filters planes wave by wave, for solvers that take diffusion implicitly.
//
// Each plane is transformed into waves (solvers/wave_transforms.h), each wave is multiplied by a
// factor or taken through a stage (solvers/etd_stages.h), and the result is transformed back.
#pragma once

#include "core/parallel.h"
#include "core/side.h"
#include "ir/diffusion.h"
#include "ir/sweep_form.h"
#include "solvers/etd_stages.h"
#include "solvers/wave_damping.h"
#include "solvers/wave_transforms.h"

#include <span>
#include <vector>

namespace cascade {

template <typename Number>
class WaveFilter {
public:
    /// `sides` are by species. Throws std::bad_alloc.
    WaveFilter(const Grid& grid, const std::vector<SideRules>& sides) : transforms_(grid, sides) {}

    /// The addresses of cells (0, 0, 0), one for each species.
    using Planes = std::vector<Number*>;
    struct FilteredPlanes {
        Planes filtered;
        std::vector<Planes> kept;  ///< Of the stages of etdrk4: etd_registers.
        Planes error;              ///< Of its last stage, or empty.
    };
    /// Replaces every wave of the filtered planes by its response in a step of that length. Called
    /// by the first `threads` threads of the team, as WaveTransforms::apply().
    void apply(Team& team, int thread, int threads, const FilteredPlanes& planes,
               std::span<const DiffusionSymbol> symbols, WaveResponse response,
               double length) const;

private:
    WaveTransforms<Number> transforms_;
};

extern template class WaveFilter<float>;
extern template class WaveFilter<double>;

}  // namespace cascade
