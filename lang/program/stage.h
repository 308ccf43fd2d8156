// A checked stage: starting values, settings of time, and conditions at the sides of the domain.
#pragma once

#include "lang/program/growth.h"
#include "lang/program/system.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// The time of a stage (spec/time.md).
struct StageTime {
    Solver solver = Solver::euler;
    Span solver_span;  ///< The place of the solver in the script, for messages.
    /// The tolerance that the script gives for steps whose length is chosen. step_tolerance() gives
    /// the value to use.
    std::optional<double> tolerance;
    /// The largest length of steps whose length is chosen.
    std::optional<double> largest_step;
    Span largest_step_span;  ///< The place of this limit in the script.
    /// The value of t at which the stage ends. Empty if `iterations` ends the stage.
    std::optional<double> duration;
    /// If given, the duration is this number times the speed at the start of the stage.
    std::optional<std::int64_t> duration_in_steps;
    /// If above 0, a step ends at each multiple of this time, and the stage is observed then.
    double every = 0;
    Span every_span;        ///< The place of `every` in the script.
    bool open_end = false;  ///< Whether only `until` or the largest number of steps ends the stage.
    bool automatic_speed = false;  ///< Whether steps are as long as stability and accuracy allow.
    std::optional<Formula> until;  ///< A condition, equal in all cells, that ends the stage.
    std::optional<double> steady;  ///< Ends the stage when its pattern has settled to this degree.
    std::optional<std::int64_t> check;  ///< The number of steps between two evaluations of `until`.
    /// The stage first runs on a grid whose cells are wider by this factor. 1 if there is no such
    /// first run.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< The place of `coarse` in the script.

    bool has_duration() const { return duration || duration_in_steps; }
    /// Whether the lengths of steps are chosen while the stage runs.
    bool chooses_steps() const { return automatic_speed || is_adaptive(solver); }
    /// The relative error of a step whose length is chosen.
    double step_tolerance() const {
        return tolerance.value_or(is_adaptive(solver) ? default_tolerance
                                                      : default_automatic_tolerance);
    }
    static constexpr double default_tolerance = 1e-4, default_automatic_tolerance = 1e-3;
    /// The number of steps between two evaluations of `until`. Long steps need more frequent
    /// checks.
    std::int64_t steps_between_looks() const {
        return check.value_or(chooses_steps() || takes_long_steps(solver) ? 10 : 100);
    }
};

/// The cells with which a stage of cells starts.
struct Founders {
    std::int64_t count = 0;  ///< The number of cells at random positions. 0 if positions are given.
    Formula chance;          ///< The probability that a random position is used. If empty, it is 1.
    std::vector<double> places;  ///< Three coordinates for each cell, in the script's unit of
                                 ///< length.
    Span span;
};

/// The wavelength that the pattern of a stage should have, written `size: 16`.
struct StageSize {
    double wanted = 0;  ///< The wavelength in the domain's units.
    Span span;          ///< The place of the size in the script.
    /// The largest number of steps of the stage; 0 if there is no limit. The stage may end earlier.
    std::int64_t steps = 0;
    /// The factor by which lengths in the stage are scaled to reach this size. If it is not 1,
    /// with_lengths() has scaled them.
    double factor = 1;
};

struct Stage {
    std::string name;  ///< The name in the script, or else stage1, stage2, … by position.
    Span span;
    SystemId system;
    IdVector<ItemId, Formula> items;  ///< The starting value of every item.
    std::vector<ItemId> order;        ///< An order in which each item can be evaluated.
    IdVector<ItemId, bool> uniform;   ///< For each item, whether it is the same in all cells. False
                                      ///< for species.
    std::int64_t iterations = 0;      ///< The number of steps. If there is a duration, the largest
                                      ///< number of steps.
    /// The number of steps between two outputs, such as pictures of a film. If 0, the time between
    /// outputs is `every`, or else a tenth of the duration.
    std::int64_t interval = 1;
    Formula show;
    StageTime time;
    /// For `grid: coarse(…)`: the ratio of the width of the stage's cells to the width of the
    /// domain's cells.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< The place of `grid: coarse(…)` in the script.
    std::optional<StageSize> size;
    std::optional<Growth> growth;  ///< If empty, lengths do not change.
    /// The species that growth does not dilute, in any order.
    std::vector<ItemId> undiluted;
    /// The rules for each species. Empty if the rules of the domain apply to all species.
    IdVector<SpeciesId, SideSettings> sides;
    std::vector<DefinitionSides> definition_sides;  ///< In the order of the definitions.
    // For a stage of cells that crawl.
    /// For `size: 2`: the distance from one cell to the next in units of the domain, which is twice
    /// the starting radius. 0 if the radii are lengths in the script's unit. On a model the run
    /// sets the starting value of the radius.
    double cell_size = 0;
    std::optional<Founders> founders;  ///< If empty, the stage continues with the cells of the
                                       ///< previous stage of cells.
    Formula remove;  ///< At the start, cells where this formula is not 0 are removed. If empty,
                     ///< none are.
    /// A formula that is above 0 inside a body in a volume. The cells are on the surface of this
    /// body. The formula is evaluated in the cells of the grid, after the stages of fields that it
    /// reads. If it is empty, cells stay where they were in the previous stage of cells, and
    /// founders are placed on the domain's model or plane, or in its box.
    Formula body;
};

}  // namespace cascade
