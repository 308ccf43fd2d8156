// Tries steps of a tissue (internal to tissue/).
#pragma once

#include "core/parallel.h"
#include "solvers/stepper.h"
#include "tissue/cell_lists.h"
#include "tissue/event_search.h"
#include "tissue/sense_kernel.h"
#include "tissue/tissue.h"
#include "tissue/tissue_loop.h"
#include "tissue/tissue_rules.h"
#include "tissue/value_runner.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The root mean square over the cells of each of these planes, or of their differences to
/// `others`. NaN if one is NaN. Threads share the planes.
std::vector<double> root_mean_squares(const std::vector<Field>& fields, const Tissue& tissue,
                                      Team& team, const std::vector<Field>* others = nullptr);

/// The size of each species, for comparison with errors and speeds: the mean radius for positions,
/// the root mean square for others, and at least 1e-30.
std::vector<double> sizes_of(const std::vector<Field>& species, const Tissue& tissue,
                             const TissueSpecies& roles, double mean_radius, Team& team);

/// A failure of the tissue as it is.
TissueFailure failure_of(TissueFailure::Kind kind, const Tissue& tissue);
/// Blames the first cell by number with a value that is not finite.
std::optional<TissueFailure> find_not_finite(const Tissue& tissue);

/// A tried step. The values at its end are current.
struct TriedStep {
    CopyRoles before;  ///< At the step's beginning.
    double error =
        0;  ///< In units of the tolerance. NaN if a value is not finite. 0 if not judged.
    bool went_too_far = false;
};

/// Owns everything that must be remade when planes move. Between calls tissue.species holds the
/// current values.
class TissueStepper {
public:
    TissueStepper(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
                  std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
                  const TissueSchedule& schedule);

    /// Must be called first and after every change of cells, with whether the planes have moved.
    /// Finds the lists, and rebinds everything if planes moved. `only`: the cells that are new or
    /// have moved, if no others have changed. Empty: all.
    Result<void> cells_changed(bool has_moved, std::span<const std::uint32_t> only = {});
    /// Reorders the cells if that saves more time than it takes.
    Result<void> order_cells();

    /// Makes lists that are valid for this state and for some distance around its positions, unless
    /// they are. Values may then be evaluated there.
    Result<void> reach(const std::vector<Field>& state, double around = 0);
    /// Does the same for the present, if only these cells have changed since lists were valid.
    Result<void> reach(std::span<const std::uint32_t> cells);

    /// Tries a step of this length, with lists that reach far enough. Call accept() or undo() next.
    Result<TriedStep> attempt(double length);
    /// The events of the tried step, of this length. If they are too many for one step, it ends
    /// earlier, and the current values are those at that moment.
    struct StepEvents {
        double part = 1;  ///< The part of the step at which it ends.
        std::vector<CellEvent> events;
        bool has_all = false;  ///< No condition holds at the end for any other cell.
    };
    Result<StepEvents> events(const TriedStep& tried, double length);
    void accept();
    void undo(const TriedStep& tried);
    /// The values at the beginning of a tried step. They must be given back.
    std::vector<Field> lend_beginning(const TriedStep& tried);
    void take_beginning(const TriedStep& tried, std::vector<Field> values);
    const std::vector<Field>& errors() const { return stepper_->error_planes(); }

    /// The moment at which a step of this length begins.
    StepMoment moment(double length) const;
    /// Called when values have been changed from outside.
    void forget_rates() { stepper_->forget_rates(); }
    /// The longest step that the solver can take, by the stiffness.
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
    std::map<std::uint32_t, StepProblem> problems_;  ///< By number of stages.
    std::optional<Stepper> stepper_;
};

}  // namespace cascade
