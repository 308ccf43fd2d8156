// A checked stage: starting values, settings of time, and conditions at the sides of the domain.
#pragma once

#include "lang/program/growth.h"
#include "lang/program/system.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// When the steps of a stage take place and when the stage ends (spec/time.md).
struct StageTime {
    Solver solver = Solver::euler;
    Span solver_span;  ///< Where the solver is in the script, for messages.
    /// The tolerance in the script, if steps have a chosen length. step_tolerance() returns the
    /// tolerance that applies.
    std::optional<double> tolerance;
    /// The limit in the script for the length of steps, if the length is chosen.
    std::optional<double> largest_step;
    Span largest_step_span;  ///< Where this limit is in the script.
    /// The value of t at which the stage ends. Empty if `iterations` ends the stage.
    std::optional<double> duration;
    /// If given, the duration is this number multiplied by the speed at the start of the stage.
    std::optional<std::int64_t> duration_in_steps;
    /// If above 0, a step ends at each multiple of this time, and the stage is observed at the end
    /// of this step.
    double every = 0;
    Span every_span;  ///< Where `every` is in the script.
    /// Whether the stage has no end besides `until` and the largest number of steps.
    bool open_end = false;
    /// Whether steps are made as long as stability and accuracy allow.
    bool automatic_speed = false;
    std::optional<Formula> until;  ///< A condition that is equal in all cells and ends the stage.
    /// The number in `until: steady(…)`: the stage ends when its pattern has settled to this
    /// degree.
    std::optional<double> steady;
    /// The number of steps from one evaluation of `until` to the next.
    std::optional<std::int64_t> check;
    /// The stage first runs on a grid whose cells are wider by this factor. 1 if there is no such
    /// first run.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< Where `coarse` is in the script.

    bool has_duration() const { return duration || duration_in_steps; }
    /// Whether the lengths of steps are chosen while the stage runs.
    bool chooses_steps() const { return automatic_speed || is_adaptive(solver); }
    /// The relative error that is allowed in a step of chosen length.
    double step_tolerance() const {
        return tolerance.value_or(is_adaptive(solver) ? default_tolerance
                                                      : default_automatic_tolerance);
    }
    static constexpr double default_tolerance = 1e-4, default_automatic_tolerance = 1e-3;
    /// The number of steps from one evaluation of `until` to the next. If steps are long, `until`
    /// is evaluated after fewer steps.
    std::int64_t steps_between_looks() const {
        return check.value_or(chooses_steps() || takes_long_steps(solver) ? 10 : 100);
    }
};

/// The cells with which a stage of crawling cells starts.
struct Founders {
    std::int64_t count = 0;  ///< The number of cells at random positions. 0 if positions are given.
    /// The probability with which each random position is used. If empty, all are used.
    Formula chance;
    /// Three coordinates for each cell, in the script's unit of length.
    std::vector<double> places;
    Span span;
};

/// The wavelength that the pattern of a stage should have, written `size: 16`.
struct StageSize {
    double wanted = 0;  ///< The wavelength in the domain's units.
    Span span;          ///< Where the size is in the script.
    /// The largest number of steps that the stage may take; 0 if there is no limit. The stage may
    /// end earlier.
    std::int64_t steps = 0;
    /// The factor by which lengths in the stage are scaled to reach this size. If the factor is not
    /// 1, with_lengths() has already scaled them.
    double factor = 1;
};

struct Stage {
    /// The name in the script. A stage without a name is called stage1, stage2, … by its position.
    std::string name;
    Span span;
    SystemId system;
    IdVector<ItemId, Formula> items;  ///< The starting value of every item.
    std::vector<ItemId> order;        ///< The order in which the items are evaluated.
    /// For each item, whether it is the same in all cells. False for species.
    IdVector<ItemId, bool> uniform;
    /// The number of steps. If the stage has a duration, the largest number of steps.
    std::int64_t iterations = 0;
    /// The number of steps between two outputs, such as pictures of a film. If 0, outputs are a
    /// fixed time apart: `every` or, without `every`, a tenth of the duration.
    std::int64_t interval = 1;
    Formula show;
    StageTime time;
    /// For `grid: coarse(…)`: the width of the stage's cells divided by the width of the domain's
    /// cells.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< Where `grid: coarse(…)` is in the script.
    std::optional<StageSize> size;
    std::optional<Growth> growth;  ///< If empty, the lengths of the domain do not change.
    /// The species that growth does not dilute, in any order.
    std::vector<ItemId> undiluted;
    /// For each species, its rules at the sides. Empty if the domain's rules apply to all species.
    IdVector<SpeciesId, SideSettings> sides;
    std::vector<DefinitionSides> definition_sides;  ///< Sorted by definition.
    // The following members are for stages of crawling cells.

    /// For `size: 2`: the distance from one cell to the next in units of the domain. It is twice
    /// the starting radius. 0 if the radii are lengths in the script's unit. On a model the run
    /// sets the starting value of the radius.
    double cell_size = 0;
    /// If empty, the stage continues with the cells of the previous stage of crawling cells.
    std::optional<Founders> founders;
    /// At the start, cells in which this formula is not 0 are removed. If empty, no cells are
    /// removed.
    Formula remove;
    /// A formula that is above 0 inside a body in a volume. The cells are on the surface of the
    /// body. The formula is evaluated in the cells of the grid, after the stages of fields that it
    /// reads. If there is no formula, cells stay where they were in the previous stage of crawling
    /// cells, and founders are placed on the domain's model or plane, or in its box.
    Formula body;
};

}  // namespace cascade
