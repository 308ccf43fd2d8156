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
/// `others`; NaN if one is NaN. Threads share the planes.
std::vector<double> root_mean_squares(const std::vector<Field>& fields, const Tissue& tissue,
                                      Team& team, const std::vector<Field>* others = nullptr);

/// The size of each species, which errors and speeds are compared with: the mean radius for places,
/// for others their root mean square, and at least 1e-30.
std::vector<double> sizes_of(const std::vector<Field>& species, const Tissue& tissue,
                             const TissueSpecies& roles, double mean_radius, Team& team);

/// A failure of the tissue as it is.
TissueFailure failure_of(TissueFailure::Kind kind, const Tissue& tissue);
/// One that blames the first cell by number with a value that is not finite.
std::optional<TissueFailure> find_not_finite(const Tissue& tissue);

/// A step that has been tried. The values that it leads to are current.
struct TriedStep {
    CopyRoles before;  ///< Of the step's beginning.
    double error =
        0;  ///< In units of the tolerance; NaN if a value is not finite. 0 if not judged.
    bool went_too_far = false;
};

/// Owns what must be made anew when planes move. Between calls tissue.species holds the current
/// values.
class TissueStepper {
public:
    TissueStepper(TissueRules& rules, const Surroundings& surroundings, Tissue& tissue,
                  std::shared_ptr<NearTriangles> triangles, const TissueSpecies& species,
                  const TissueSchedule& schedule);

    /// To be called first of all and after every change of cells, with whether the planes have
    /// moved: finds the lists, and binds everything if they have. `only`: the cells that are new or
    /// elsewhere, if no others have changed; empty: all.
    Result<void> cells_changed(bool has_moved, std::span<const std::uint32_t> only = {});
    /// Puts the cells in another order if that saves more time than it takes.
    Result<void> order_cells();

    /// Makes lists that hold for this state and for some way around its places, unless they do.
    /// Values may then be evaluated there.
    Result<void> reach(const std::vector<Field>& state, double around = 0);
    /// The same for the present, in which only these cells may have changed since the lists held.
    Result<void> reach(std::span<const std::uint32_t> cells);

    /// Tries a step of this length, with lists that reach far enough. Call accept() or undo().
    Result<TriedStep> attempt(double length);
    /// What happens in the step that was tried, of this length. If it is too much for one step,
    /// this ends earlier, and the values that it leads to are those at that moment.
    struct StepEvents {
        double part = 1;  ///< Of the step, at which it ends.
        std::vector<CellEvent> events;
        bool has_all = false;  ///< No condition holds at the end for any other cell.
    };
    Result<StepEvents> events(const TriedStep& tried, double length);
    void accept();
    void undo(const TriedStep& tried);
    /// The values at the beginning of a step that was tried, which must be given back.
    std::vector<Field> lend_beginning(const TriedStep& tried);
    void take_beginning(const TriedStep& tried, std::vector<Field> values);
    const std::vector<Field>& errors() const { return stepper_->error_planes(); }

    /// The moment before a step of this length.
    StepMoment moment(double length) const;
    /// Values have been changed from outside.
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
    std::map<std::uint32_t, StepProblem> problems_;  ///< By stages.
    std::optional<Stepper> stepper_;
};

}  // namespace cascade
