// Divides and removes cells until no condition holds (internal to tissue/).
#pragma once

#include "tissue/event_search.h"
#include "tissue/tissue_stepper.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
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

    /// Applies the events of a step and advances their cells to the end of the step, which is the
    /// present. Then applies all events whose conditions hold at present, and repeats this until no
    /// condition holds. If `are_all` is true, no condition holds at present for any cell without an
    /// event. Returns the failure that ends the stage, if there is one.
    std::optional<TissueFailure> happen(std::vector<CellEvent> events, bool are_all);
    /// Whether any cell has divided or died.
    bool has_changed() const { return has_changed_; }

private:
    std::optional<TissueFailure> one_round(std::span<const CellEvent> events);
    std::optional<TissueFailure> refuse(std::span<const CellEvent> events);
    std::vector<Vector3d> directions(std::span<const CellEvent> events);
    void restart(std::span<const CellEvent> dividing, const Divided& divided);
    Result<void> carry(std::span<const CellEvent> dividing, const Divided& divided);
    bool is_place(std::size_t species) const { return species - species_.place < 3; }
    std::vector<Field>& run(const CellValues& values, std::span<const std::uint32_t> among = {});

    TissueRules& rules_;
    const Surroundings& surroundings_;
    Tissue& tissue_;
    const TissueSpecies& species_;
    const TissueSchedule& schedule_;
    TissueStepper& stepper_;
    /// By cell number: how often the cell, counting its line of mothers, has divided at this
    /// moment.
    std::map<std::uint32_t, int> divisions_;
    bool has_changed_ = false;
    /// The cells of the last round's divisions, in the order of their numbers.
    std::vector<std::uint32_t> changed_;
};

}  // namespace cascade
