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

/// Maps the numbers of constraints in Literals to reports on their solutions.
using SolveReports = std::map<std::uint32_t, std::shared_ptr<SolveReport>>;

/// The progress of a stage, and everything besides the values that determines its further steps.
struct StageMoment {
    bool done = false;           ///< Whether all steps are complete or the stage has ended early.
    bool condition_met = false;  ///< Whether `until` has ended the stage.
    std::int64_t steps = 0;      ///< The number of complete steps.
    double t = 0;                ///< The time since the start of the stage. 0 if `speed` varies.
    TimeState time;              ///< The state of the step control.
    SteadyWatch watch;           ///< The last evaluation of `until: steady(…)`.
};

/// The values of a stage of fields.
struct FieldState {
    /// The planes of parameters. Empty for uniform items and for species.
    IdVector<ItemId, Field> parameters;
    std::vector<Field> species;  ///< The planes of species, by SpeciesId.
    Mask frozen;                 ///< Empty if `frozen` is uniform.
    /// The rules at the sides, by species and then as in Stage::definition_sides. Empty if the
    /// boundary of the domain applies everywhere.
    std::vector<SideRules> sides;
    std::vector<ChangingSide> changing_sides;  ///< The sides whose values change during the stage.
    /// Reports on the solutions of constraints in the stage's steps. Never null.
    std::shared_ptr<SolveReports> constraints = std::make_shared<SolveReports>();
};

/// The values of a stage of cells that crawl.
struct TissueState {
    std::shared_ptr<const TissueGround> ground;  ///< The surroundings of the cells.
    std::shared_ptr<Tissue> tissue;              ///< Null until there are cells.
};

/// The values of one stage's items. A copy must be made explicitly, and has its own planes.
struct StageState : StageMoment {
    StageState() = default;
    explicit StageState(const StageState&) = default;
    StageState(StageState&&) = default;
    StageState& operator=(StageState&&) = default;

    bool started = false;
    /// Begins at the start of the stage or, if a saved run was resumed, at that moment.
    StageCourse course;
    /// The values of uniform items, rounded to the run's precision. All other elements are
    /// meaningless.
    IdVector<ItemId, double> numbers;
    IdVector<ItemId, std::optional<SpeciesId>> species_of_item;
    /// Contains a FieldState until the stage has started.
    std::variant<FieldState, TissueState> values;

    FieldState& fields() { return std::get<FieldState>(values); }
    const FieldState& fields() const { return std::get<FieldState>(values); }
    /// Returns the tissue of crawling cells. Returns null for fields, and until there are cells.
    Tissue* tissue() const;
    /// Returns the surroundings of the crawling cells, or null for fields.
    std::shared_ptr<const TissueGround> ground() const;

    // For stages of both kinds:
    /// Returns the species, by SpeciesId. Their planes may be missing while steps are being taken,
    /// because they may be lent to the steps.
    std::vector<Field>& species();
    const std::vector<Field>& species() const;
    /// Returns the plane of an item that varies: a species or a varying parameter.
    const Field& field(ItemId item) const;
    /// Returns the mask of frozen cells. The mask is empty if `frozen` is uniform.
    const Mask& frozen() const;
    /// Returns FieldState::sides for a stage of fields. Empty for cells that crawl.
    std::span<const SideRules> sides() const;

    /// Sets the progress of the stage. Computes the values of sides that change in time, for
    /// `time_then` and from the present species.
    void go_to(std::int64_t complete, double time_then);
};

/// The numbers of cells in a stage of crawling cells.
struct CellCounts {
    std::int64_t count = 0, births = 0, deaths = 0;
};
/// Returns the numbers of cells. Returns an empty optional for a stage of fields, and for a stage
/// that has not started.
std::optional<CellCounts> counts_of_cells(const StageState& state);

/// Makes a state with room for all items of a system, but without planes or cells.
StageState empty_state(const System& system);

/// Moves the values in `planes` to items, in the stage's own cells. An item that is uniform in the
/// stage takes the first number of its plane. Values outside a mask must be 0. Values of cells that
/// crawl must be in the order in which evaluations return them.
void take_values(StageState& state, const Program& program, std::uint32_t stage,
                 std::span<const ItemId> items, std::span<Field> planes);

/// Describes the progress of a stage: "step 300 of 7000", "step 312, t = 4.5 of 30", or "step 312"
/// if only `until` ends the stage.
std::string describe_place(const Stage& stage, const StageState& state);

}  // namespace cascade
