// Tries steps of a tissue (internal to tissue/).
#pragma once

#include "core/parallel.h"
#include "core/run_control.h"
#include "solvers/stepper.h"
#include "tissue/cell_lists.h"
#include "tissue/event_search.h"
#include "tissue/sense_kernel.h"
#include "tissue/tissue.h"
#include "tissue/tissue_loop.h"
#include "tissue/tissue_rules.h"
#include "tissue/value_runner.h"

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The root mean square, over the cells, of each of `fields`. If `others` is not null, the root
/// mean square of the difference between each field and the field of `others` with the same index.
/// NaN if a value is NaN. The threads of the team share the planes.
std::vector<double> root_mean_squares(const std::vector<Field>& fields, const Tissue& tissue,
                                      Team& team, const std::vector<Field>* others = nullptr);

/// The size of each species, by which errors and speeds are divided: the mean radius for positions,
/// the root mean square for all other species, and at least 1e-30.
std::vector<double> sizes_of(const std::vector<Field>& species, const Tissue& tissue,
                             const TissueSpecies& roles, double mean_radius, Team& team);

/// Describes a failure of the tissue in its present state.
TissueFailure failure_of(TissueFailure::Kind kind, const Tissue& tissue);
/// Finds the first cell, by number, with a value that is not finite.
std::optional<TissueFailure> find_not_finite(const Tissue& tissue);

/// The result of a tried step. The current values are the values at the end of this step.
struct TriedStep {
    CopyRoles before;  ///< The roles at the beginning of the step.
    /// The error of the step in units of the tolerance. NaN if a value is not finite. 0 if errors
    /// are not estimated.
    double error = 0;
    bool went_too_far = false;
    /// Whether the step was abandoned. The current values are then the values at the beginning of
    /// the step, and no function of this class may be called any more.
    bool is_abandoned = false;
};

/// Called with the curve through a tried step, and with the resulting StepEvents::part.
using CurveUser = std::function<void(const StepCubic& curve, double part)>;

/// Owns everything that must be made again when planes move. Between calls, tissue.species holds
/// the current values.
class TissueStepper {
public:
    TissueStepper(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
                  std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
                  const TissueSchedule& schedule);

    /// Builds the lists. Must be called first and after every change of cells. If `has_moved` is
    /// true, the planes have moved, and everything is bound again. `only` lists the cells that are
    /// new or have moved, if no other cells have changed. If `only` is empty, the lists of all
    /// cells are built.
    Result<void> cells_changed(bool has_moved, std::span<const std::uint32_t> only = {});
    /// Reorders the cells if that saves more time than it takes.
    Result<void> order_cells();

    /// Builds lists, if necessary, so that values may be evaluated in this state and at positions
    /// within a distance `around` of those in this state.
    Result<void> reach(const std::vector<Field>& state, double around = 0);
    /// Builds lists, if necessary, so that values may be evaluated in the present state. Since
    /// lists were last valid, only the given cells may have changed.
    Result<void> reach(std::span<const std::uint32_t> cells);

    /// From now on attempt() abandons its step when `cancel` becomes true.
    void leave_on(const std::atomic<bool>& cancel) { cancel_ = &cancel; }
    /// Tries a step of this length, with lists that are valid during the step. The caller must then
    /// call accept() or undo().
    Result<TriedStep> attempt(double length);
    /// The events of the tried step; none if no cell can divide or die. If there are too many
    /// events for one step, the step ends early, and the current values become the values at that
    /// moment. `use`, which may be empty, may read the values between the ends of the step.
    struct StepEvents {
        double part = 1;  ///< The fraction of the tried step after which the step ends.
        std::vector<CellEvent> events;
        /// Whether no condition holds at the end of the step for any cell without an event.
        bool has_all = false;
    };
    Result<StepEvents> events(const TriedStep& tried, double length, const CurveUser& use = {});
    void accept();
    void undo(const TriedStep& tried);
    /// Gives the values at the beginning of a tried step to the caller, who must give them back.
    std::vector<Field> lend_beginning(const TriedStep& tried);
    void take_beginning(const TriedStep& tried, std::vector<Field> values);
    const std::vector<Field>& errors() const { return stepper_->error_planes(); }

    /// The moment at which a step of this length begins.
    StepMoment moment(double length) const;
    /// Called when values have been changed from outside.
    void forget_rates() { stepper_->forget_rates(); }
    /// The longest step that the solver can take at the present stiffness.
    double longest_step() const;
    std::vector<double> sizes();

    ValueRunner& values() { return values_; }
    CellLists& lists() { return lists_; }
    Team& team() { return team_; }

private:
    Result<void> build_lists(const std::vector<Field>& state, bool is_full);
    void links_changed();
    void end_at(std::vector<CellEvent>& found, const StepCubic& cubic, StepEvents& result);
    StageClock clock(double length) const;
    const StepProblem& problem(std::uint32_t stages);
    std::uint32_t stages(double length) const;
    double error();

    TissueRules& rules_;
    Tissue& tissue_;
    std::shared_ptr<NearTriangles> triangles_;
    TissueSpecies species_;
    const TissueSchedule& schedule_;
    Team team_;
    CellLists lists_;
    ValueRunner values_;
    std::map<std::uint32_t, StepProblem> problems_;  ///< The problem for each number of stages.
    std::optional<Stepper> stepper_;
    const std::atomic<bool>* cancel_ = &never_cancelled;
};

}  // namespace cascade
