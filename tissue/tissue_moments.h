// Observes a tissue at given moments between its steps (internal to tissue/).
#pragma once

#include "core/vector3.h"
#include "tissue/event_search.h"
#include "tissue/surroundings.h"
#include "tissue/tissue.h"
#include "tissue/tissue_loop.h"

#include <cstdint>
#include <functional>

namespace cascade {

/// Moves cells that have left the surroundings back inside, and calls `moved` for each of these
/// cells with its movement. Returns whether any cell has moved.
bool hold_inside(Tissue& tissue, const TissueSpecies& roles, const Surroundings& surroundings,
                 const std::function<void(std::uint32_t cell, Vector3d movement)>& moved = {});

/// Calls TissueSchedule::at_moment at the moments of TissueSchedule::next_moment. During a call for
/// a moment within a step, the tissue has the cells of the step's beginning and the values of
/// StepCubic.
class TissueMoments {
public:
    /// Moments are counted from the present time of the tissue. All arguments must outlive this
    /// object.
    TissueMoments(const TissueSchedule& schedule, const Surroundings& surroundings, Tissue& tissue,
                  const TissueSpecies& roles)
        : schedule_(schedule),
          surroundings_(surroundings),
          tissue_(tissue),
          roles_(roles),
          last_(tissue.time.t) {}

    /// Whether there is a moment within a step of this length that begins now.
    bool is_within(double length) const;
    /// Observes the moments within the first `part` of a step. Afterwards the tissue has its
    /// present values again, which are the values at the end of the curve.
    void observe(const StepCubic& curve, double part);
    /// Observes the moments at the end of a step of this length.
    void observe_end(double length);

private:
    const TissueSchedule& schedule_;
    const Surroundings& surroundings_;
    Tissue& tissue_;
    const TissueSpecies& roles_;
    double last_;  ///< The moment observed last.
};

}  // namespace cascade
