// The values of one stage, and how far it has come.
#pragma once

#include "core/plane.h"
#include "core/side.h"
#include "lang/program/program.h"
#include "run/stage/stage_course.h"
#include "solvers/changing_side.h"
#include "solvers/solve_report.h"
#include "solvers/stage_clock.h"
#include "solvers/steady.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

class Tissue;
class TissueGround;

/// What is known of the solutions of constraints, by their numbers in Literals.
using SolveReports = std::map<std::uint32_t, std::shared_ptr<SolveReport>>;

/// How far a stage has come, and what its further steps depend on besides values.
struct StageMoment {
    bool done = false;           ///< All its steps are taken, or it has ended early.
    bool condition_met = false;  ///< Its `until` has ended it.
    std::int64_t steps = 0;      ///< Complete steps.
    double t = 0;                ///< Its time; 0 if `speed` varies by cell.
    TimeState time;              ///< The state from which steps of other lengths go on.
    SteadyWatch watch;           ///< The last evaluation of `until: steady(…)`.
};

/// Values of one stage's items. A copy owns planes of its own; it is made only where that is
/// written.
struct StageState : StageMoment {
    StageState() = default;
    explicit StageState(const StageState&) = default;
    StageState(StageState&&) = default;
    StageState& operator=(StageState&&) = default;

    bool started = false;
    StageCourse course;                ///< Since it began, or went on from a saved run.
    IdVector<ItemId, double> numbers;  ///< Of the run's precision; meaningful where uniform.
    IdVector<ItemId, Field> fields;    ///< Empty where uniform, and for species.
    std::vector<Field> species;        ///< By SpeciesId.
    IdVector<ItemId, std::optional<SpeciesId>> species_of_item;
    Mask frozen;  ///< Only where `frozen` varies.
    /// Of a stage of cells that crawl: their values, in place of `fields`, `species` and `frozen`.
    std::shared_ptr<Tissue> tissue;
    std::shared_ptr<const TissueGround> ground;  ///< Where these cells are.
    /// By species, then by Stage::definition_sides; empty if the boundary holds for all.
    std::vector<SideRules> sides;
    std::vector<ChangingSide> changing_sides;  ///< The sides whose values change.
    /// Of the constraints that its steps have solved; never null.
    std::shared_ptr<SolveReports> constraints = std::make_shared<SolveReports>();

    /// Sets the progress of the stage, and the values of sides to those of that moment, at which
    /// species have their present values.
    void go_to(std::int64_t complete, double time_then);

    /// The plane of an item that varies (a species or a varying parameter).
    const Field& field(ItemId item) const;
    /// Where `frozen` varies.
    const Mask& frozen_cells() const;
};

/// The cells of a stage of cells that crawl.
struct CellCounts {
    std::int64_t count = 0, births = 0, deaths = 0;
};
/// Nothing of a stage of fields, and before a stage has started.
std::optional<CellCounts> counts_of_cells(const StageState& state);

/// A state with room for all items of a system, but without planes.
StageState empty_state(const System& system);

/// Gives a species other values, or a parameter or `frozen` that varies, in the stage's own cells.
/// Values outside of a mask must be 0; those of cells that crawl are where evaluations have them.
void set_item(StageState& state, const System& system, ItemId item, Field values);

/// The progress of a stage: "step 300 of 7000", "step 312, t = 4.5 of 30", or "step 312" if only
/// `until` ends it.
std::string describe_place(const Stage& stage, const StageState& state);

}  // namespace cascade
