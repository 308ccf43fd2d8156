// Lowering turns the formulas of a checked program into cell kernels. It cannot fail.
//
// For a stage, `plan_uniform_start` computes the starting values that are the same in all cells (on
// a grid of one cell), and the plan of starting values computes those that vary. The plan of a step
// then computes the new value of every species from the old step:
//
//     new = old + speed · rate, clamped by the invariants in order of writing; old where frozen,
//
// or there are plans for the sweeps of another integrator. Outside of the mask of the domain, items
// that vary are 0 at the start and after every step, and rates are 0. The plan of a view computes a
// picture: one result (a number) or three (a colour).
#pragma once

#include "core/grid.h"
#include "ir/cell_kernel.h"
#include "ir/sweep_form.h"
#include "lang/lower/step_plan.h"
#include "lang/program/program.h"

#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The stage's uniform items in their order, except those that need an aggregate. One pass without
/// field slots. May have no results.
StepPlan plan_uniform_start(const Program& program, std::uint32_t stage);

/// Starting values of all other items. A result that is uniform (Stage::uniform) has the same value
/// in all cells of its plane. `frozen`, if it varies, is stored as a number like the others. The
/// places of cells that crawl are not among them, but read like what is computed elsewhere.
StepPlan plan_start(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// One explicit Euler step, with one result for each species. If `frozen` varies, it is a mask
/// slot. If it is the same in all cells, kernels do not read it; if it is true, the time loop takes
/// no steps.
StepPlan plan_step(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// One sweep of a time integrator: result o·S + s is output o of the s-th of the S species written.
/// Formulas read input 0, the items of the stage (StageItem); further inputs are only read in the
/// cell itself.
StepPlan plan_sweep(const Program& program, std::uint32_t stage, const SweepForm& form,
                    const PlanOptions& options = {});

/// The form of an explicit Euler step of `speed`.
SweepForm euler_form();

/// The rates alone, without the time step, one result for each species; for estimates of stability.
StepPlan plan_rates(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// The formula that decides which cells are inside the mask of the domain: one result. The domain
/// must have a mask, and the program a stage.
StepPlan plan_mask(const Program& program);
/// The step-invariants of a stage, as far as keeping them pays (PlanOptions::keeps_step_invariants;
/// without it none). Result k is step-invariant part k, which every step reads from a plane or, if
/// it is the same in all cells, as a number.
StepPlan plan_step_invariants(const Program& program, std::uint32_t stage,
                              const PlanOptions& options);

/// The value of a side of fixed value or slope, as side_settings() of lang/calculus gives it; for a
/// slope on a surface in units of the grid.
struct SidePlans {
    bool changes = false;  ///< It depends on t, step or species.
    StepPlan once;         ///< For a changing value: its step-invariants.
    /// The value. For a changing value this is a single pass that reads planes and numbers in the
    /// cell itself and does not depend on the place.
    StepPlan each;
};
SidePlans plan_side(const Program& program, const SideSetting& setting, Side side,
                    std::uint32_t stage);

/// Formulas over the present state, with one result each. A colour has three: red, green and blue,
/// 0 … 1, not clamped. Outside of the mask, results are NaN unless they are the same in all cells.
StepPlan plan_view(const Program& program, std::span<const Formula* const> formulas,
                   std::uint32_t stage, const PlanOptions& options = {});
StepPlan plan_view(const Program& program, const Formula& formula, std::uint32_t stage);

/// The values with which quantities of a stage of cells start again after a division, one result
/// for each item that has such a value, over the state of the new cells before: their numbers draw.
StepPlan plan_restarts(const Program& program, std::uint32_t stage);

/// The expression graphs of every stage after each pass that changes one, for `--dump graph`.
std::string describe_graphs(const Program& program);

/// The passes of every stage and the reasons for them, for `--dump plan`.
std::string describe_plans(const Program& program);

}  // namespace cascade
