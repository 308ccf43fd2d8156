// Sides whose values change: with time, as in u.left: fixed(sin(t)), or with the species in the
// cells beside them, as in u.left: slope(w - u).
//
// The values at a side determine the halo beyond it. So before a thread fills a halo, it computes
// the side's values for the moment at which the halo will be read. The cells beside a side are
// numbered along it, so that a small kernel computes only the values that a few rows need. The
// thread reads species in the cells that the current pass has just written, so it never waits for
// another thread.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/precision.h"
#include "core/side.h"
#include "ir/backend.h"
#include "ir/sweep_form.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The moment for which side values are computed.
struct SideMoment {
    std::int64_t step = 0;  ///< Number of complete steps.
    double t = 0;           ///< The stage's time.
};

struct ChangingSide {
    SpeciesId species;
    Side side = Side::left;
    /// Computes the side's values. The kernel has one result and reads no neighbours or positions.
    KernelPointer kernel;
    Precision precision = Precision::single;  ///< The precision of the kernel.
    /// Per field slot of the kernel: the values along the side if they do not change with time.
    /// Empty for a slot that reads a species.
    std::vector<std::vector<double>> strips;
    /// Per field slot of the kernel: the species that the slot reads; nullopt for a slot whose
    /// values are in `strips`.
    std::vector<std::optional<SpeciesId>> reads;
    std::vector<double> uniforms;
    std::optional<std::uint32_t> time_slot, step_slot;  ///< The uniforms that depend on the moment.
    bool varies = false;                                ///< Whether values vary along the side.
};

/// The planes of all species at one moment; null for a species that no side reads.
using SpeciesPlanes = std::vector<const Field*>;
SpeciesPlanes planes_of(std::span<const Field> species);

/// Computes the values at a species' sides for `moment` and stores them in `rules`. Computes only
/// the values on which the halo cells beside `cells` depend. `present` holds all species at that
/// moment in `cells`. A FlushDenormals must exist in the calling scope.
void set_side_values(std::span<const ChangingSide> sides, SpeciesId species, SideMoment moment,
                     const SpeciesPlanes& present, const PlaneLayout& layout, const Patch& cells,
                     SideRules& rules);

}  // namespace cascade
