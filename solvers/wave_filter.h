// Filters planes wave by wave, for solvers that take diffusion implicitly.
//
// Each plane is transformed into waves (solvers/wave_transforms.h). Each wave is multiplied by a
// factor or goes through a stage (solvers/etd_stages.h). The result is transformed back.
#pragma once

#include "core/parallel.h"
#include "core/side.h"
#include "ir/diffusion.h"
#include "ir/sweep_form.h"
#include "solvers/etd_stages.h"
#include "solvers/wave_damping.h"
#include "solvers/wave_transforms.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

template <typename Number>
class WaveFilter {
public:
    /// `sides` has the rules of each species. Throws std::bad_alloc.
    WaveFilter(const Grid& grid, const std::vector<SideRules>& sides) : transforms_(grid, sides) {}

    /// The addresses of cells (0, 0, 0), one per species.
    using Planes = std::vector<Number*>;
    struct FilteredPlanes {
        Planes filtered;
        std::vector<Planes> kept;  ///< The etd_registers planes of the stages of etdrk4.
        Planes error;              ///< The errors. Empty except in the last stage of etdrk4.
    };
    /// Replaces every wave of the filtered planes by its response in a step of this length. The
    /// first `threads` threads of the team call this, by the same rules as WaveTransforms::apply().
    void apply(Team& team, int thread, int threads, const FilteredPlanes& planes,
               std::span<const DiffusionSymbol> symbols, WaveResponse response, double length,
               const std::atomic<bool>* cancel = nullptr) const;

private:
    WaveTransforms<Number> transforms_;
};

extern template class WaveFilter<float>;
extern template class WaveFilter<double>;

}  // namespace cascade
