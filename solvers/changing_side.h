// Sides whose values change: with time, as in u.left: fixed(sin(t)), or with the species in the
// cells beside them, as in u.left: slope(w - u).
//
// The thread that fills a halo first computes the side's values for the moment at which the halo
// will be read. The cells beside a side are numbered along it, so that a small kernel computes only
// the values that a few rows need. Species are read where the pass that computed the plane has just
// written them, so a halo never waits for another thread.
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
    std::int64_t step = 0;  ///< Complete steps.
    double t = 0;           ///< The stage's time.
};

struct ChangingSide {
    SpeciesId species;
    Side side = Side::left;
    KernelPointer kernel;                         ///< One result; reads no neighbours or positions.
    Precision precision = Precision::single;      ///< Precision of the kernel.
    std::vector<std::vector<double>> strips;      ///< Per field slot: values along the side …
    std::vector<std::optional<SpeciesId>> reads;  ///< … or the species whose values are read.
    std::vector<double> uniforms;
    std::optional<std::uint32_t> time_slot, step_slot;  ///< Uniforms set by a moment.
    bool varies = false;                                ///< Values vary along the side.
};

/// The planes of all species at one moment; null if no side reads the species.
using SpeciesPlanes = std::vector<const Field*>;
SpeciesPlanes planes_of(std::span<const Field> species);

/// Sets the rules of a species for a moment, in the halo filled from these rows. `present` has the
/// values at that moment in these rows. Must run inside a FlushDenormals.
void set_side_values(std::span<const ChangingSide> sides, SpeciesId species, SideMoment moment,
                     const SpeciesPlanes& present, const PlaneLayout& layout, const Patch& cells,
                     SideRules& rules);

}  // namespace cascade
