// A checked stage: starting values, the time that it takes, its sides.
#pragma once

#include "lang/program/system.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// The time of a stage (spec/time.md).
struct StageTime {
    Solver solver = Solver::euler;
    Span solver_span;  ///< Where it was written, for messages.
    std::optional<double>
        tolerance;  ///< For steps of chosen length, as written; see step_tolerance().
    /// The limit of steps of chosen length.
    std::optional<double> largest_step;
    Span largest_step_span;  ///< Where that was written.
    /// The stage ends at this t; empty if it ends by its iterations.
    std::optional<double> duration;
    /// The duration is this number times the speed at the start of the stage.
    std::optional<std::int64_t> duration_in_steps;
    bool open_end = false;         ///< Ended by `until` alone, or by the largest number of steps.
    bool automatic_speed = false;  ///< The step is as long as stability and accuracy allow.
    std::optional<Formula> until;  ///< Ends the stage when it is true; the same in all cells.
    std::optional<double> steady;  ///< Ends the stage when its pattern has settled to this degree.
    std::optional<std::int64_t> check;  ///< Steps between two evaluations of `until`; see below.
    /// The stage first runs on a grid whose cells are this many times as wide; 1: it does not.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< Where that was written.

    bool has_duration() const { return duration || duration_in_steps; }
    /// Are the lengths of steps chosen while the stage runs?
    bool chooses_steps() const { return automatic_speed || is_adaptive(solver); }
    /// The relative error of a step of chosen length.
    double step_tolerance() const {
        return tolerance.value_or(is_adaptive(solver) ? default_tolerance
                                                      : default_automatic_tolerance);
    }
    static constexpr double default_tolerance = 1e-4, default_automatic_tolerance = 1e-3;
    /// Steps that are as long as the state allows need more frequent checks.
    std::int64_t steps_between_looks() const {
        return check.value_or(chooses_steps() || takes_long_steps(solver) ? 10 : 100);
    }
};

/// The cells with which a stage of cells starts.
struct Founders {
    std::int64_t count = 0;      ///< Of those at random places; 0 if places are given.
    Formula chance;              ///< Of keeping a random place, from 0 to 1; empty: all.
    std::vector<double> places;  ///< Three coordinates of scripts for each.
    Span span;
};

/// The wavelength that the pattern of a stage is to have, `size: 16`.
struct StageSize {
    double wanted = 0;  ///< In units of the domain, like its spacing.
    Span span;          ///< Where it was written.
    /// Of a stage that ends by its steps, all of them; fewer may run.
    std::int64_t steps = 0;
    /// By how much lengths in the stage are scaled for that; with_lengths() has scaled them if it
    /// is not 1.
    double factor = 1;
};

struct Stage {
    std::string name;  ///< As written, or stage1, stage2, … by position.
    Span span;
    SystemId system;
    IdVector<ItemId, Formula> items;  ///< Starting value of every item.
    std::vector<ItemId> order;        ///< Items in an order in which each can be evaluated.
    IdVector<ItemId, bool> uniform;   ///< The same in all cells. Species never are.
    std::int64_t iterations = 0;      ///< With a duration: the largest number of steps.
    std::int64_t interval = 1;        ///< 0 if the stage is observed at tenths of the duration.
    Formula show;
    StageTime time;
    /// `grid: coarse(…)`: its cells are this many times as wide as those of the domain.
    std::int64_t coarse = 1;
    Span coarse_span;  ///< Where that was written.
    std::optional<StageSize> size;
    /// By species, in their order; empty if the boundary holds at all sides.
    IdVector<SpeciesId, SideSettings> sides;
    std::vector<DefinitionSides> definition_sides;  ///< In order of their definitions.
    // Of a stage of cells that crawl.
    std::optional<Founders> founders;  ///< Empty: the cells of the stage of cells before it.
    Formula remove;  ///< Cells where it is not 0 are removed at the start; empty: none.
    /// Above 0 inside of the body on whose surface they are, in a volume; read in the cells of its
    /// grid after the stages of fields that it reads. Empty: they are where they were in the stage
    /// of cells before; founders are on the domain's model or plane, or in its box.
    Formula body;
};

}  // namespace cascade
