// The values of one stage, and its progress.
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
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace cascade {

class Tissue;
class TissueGround;

/// Reports on the solutions of constraints, by the numbers of the constraints in Literals.
using SolveReports = std::map<std::uint32_t, std::shared_ptr<SolveReport>>;

/// The progress of a stage, and everything except values that determines its further steps.
struct StageMoment {
    bool done = false;           ///< All steps are complete, or the stage has ended early.
    bool condition_met = false;  ///< Whether `until` has ended the stage.
    std::int64_t steps = 0;      ///< Complete steps.
    double t = 0;                ///< The time since the start of the stage. 0 if `speed` varies.
    TimeState time;              ///< The state of the step control.
    SteadyWatch watch;           ///< The last evaluation of `until: steady(…)`.
};

/// The values of a stage of fields.
struct FieldState {
    IdVector<ItemId, Field> parameters;  ///< Empty for uniform items and for species.
    std::vector<Field> species;          ///< By SpeciesId.
    Mask frozen;                         ///< Empty if `frozen` is uniform.
    /// By species, then by Stage::definition_sides. Empty if the boundary of the domain applies
    /// everywhere.
    std::vector<SideRules> sides;
    std::vector<ChangingSide> changing_sides;  ///< The sides whose values change during the stage.
    /// Reports on the solutions of constraints in the stage's steps; never null.
    std::shared_ptr<SolveReports> constraints = std::make_shared<SolveReports>();
};

/// The values of a stage of cells that crawl.
struct TissueState {
    std::shared_ptr<const TissueGround> ground;  ///< The surroundings of the cells.
    std::shared_ptr<Tissue> tissue;              ///< Null until there are cells.
};

/// The values of one stage's items. Copies must be made explicitly, and have separate planes.
struct StageState : StageMoment {
    StageState() = default;
    explicit StageState(const StageState&) = default;
    StageState(StageState&&) = default;
    StageState& operator=(StageState&&) = default;

    bool started = false;
    /// The record from the start of the stage on, or from the moment at which a saved run was
    /// resumed.
    StageCourse course;
    /// Rounded to the run's precision. Only valid for uniform items.
    IdVector<ItemId, double> numbers;
    IdVector<ItemId, std::optional<SpeciesId>> species_of_item;
    /// Fields until the stage has started.
    std::variant<FieldState, TissueState> values;

    FieldState& fields() { return std::get<FieldState>(values); }
    const FieldState& fields() const { return std::get<FieldState>(values); }
    /// The cells that crawl. Null for fields, and until there are cells.
    Tissue* tissue() const;
    /// The surroundings of the cells that crawl. Null for fields.
    std::shared_ptr<const TissueGround> ground() const;

    // For stages of both kinds:
    /// The species, by SpeciesId. While steps are being taken, the planes may be lent to them.
    std::vector<Field>& species();
    const std::vector<Field>& species() const;
    /// The plane of an item that varies: a species or a varying parameter.
    const Field& field(ItemId item) const;
    /// The mask of frozen cells. Empty if `frozen` is uniform.
    const Mask& frozen() const;
    /// The same as FieldState::sides. Empty for cells that crawl.
    std::span<const SideRules> sides() const;

    /// Sets the progress of the stage, and computes the values of changing sides for that moment
    /// from the present species.
    void go_to(std::int64_t complete, double time_then);
};

/// The numbers of cells in a stage of crawling cells.
struct CellCounts {
    std::int64_t count = 0, births = 0, deaths = 0;
};
/// Empty for a stage of fields, and for a stage that has not started.
std::optional<CellCounts> counts_of_cells(const StageState& state);

/// A state with room for all items of a system, but without planes or cells.
StageState empty_state(const System& system);

/// Moves the values in `planes` to items, in the stage's own cells. Items that are uniform in the
/// stage take one number of their plane. Values outside a mask must be 0. Values of cells that
/// crawl must be in the order in which evaluations return them.
void take_values(StageState& state, const Program& program, std::uint32_t stage,
                 std::span<const ItemId> items, std::span<Field> planes);

/// The progress of a stage as text: "step 300 of 7000", "step 312, t = 4.5 of 30", or "step 312" if
/// only `until` ends the stage.
std::string describe_place(const Stage& stage, const StageState& state);

}  // namespace cascade
