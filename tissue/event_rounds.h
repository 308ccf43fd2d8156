// Lets cells divide and die until no condition holds (internal to tissue/).
#pragma once

#include "tissue/division.h"
#include "tissue/tissue_stepper.h"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace cascade {

/// The events of one moment.
class EventRounds {
public:
    EventRounds(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
                const TissueSpecies& species, const TissueSchedule& schedule,
                TissueStepper& stepper)
        : rules_(rules),
          surroundings_(surroundings),
          tissue_(tissue),
          species_(species),
          schedule_(schedule),
          stepper_(stepper) {}

    /// Lets `events` and all those happen whose conditions hold now, again and again until there
    /// are none. Returns the failure that ends the stage, if there is one.
    std::optional<TissueFailure> happen(CellEvents events);
    /// Has any cell divided or died?
    bool has_changed() const { return has_changed_; }

private:
    CellEvents joined(const CellEvents& a, const CellEvents& b) const;
    std::vector<Vector3d> directions(const CellEvents& events);
    std::optional<TissueFailure> one_round(const CellEvents& events);
    bool restart(const Divided& divided);
    std::vector<Field>& run(const CellValues& values);

    TissueRules& rules_;
    const Surroundings& surroundings_;
    Tissue& tissue_;
    const TissueSpecies& species_;
    const TissueSchedule& schedule_;
    TissueStepper& stepper_;
    std::map<std::uint32_t, int> divisions_;  ///< By number, in the history of each cell.
    bool has_changed_ = false;
};

}  // namespace cascade
