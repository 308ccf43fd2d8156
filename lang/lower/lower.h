// Lowering turns the formulas of a checked program into cell kernels. It never fails.
//
// For a stage, `plan_uniform_start` computes the starting values that are the same in all cells, on
// a grid of one cell. The plan of starting values computes the starting values that vary. The plan
// of a step then computes the new value of every species from the old step:
//
//     new = old + speed · rate, clamped by the bounds in the order in which they are written,
//
// and new = old where cells are frozen. These are steps of explicit Euler. All other integrators
// have a plan for each form of sweep (ir/sweep_form.h). In cells outside the mask of the domain,
// items that vary are 0 at the start and after every step, and rates are 0. The plan of a view
// computes a picture: one result (a number) or three (a colour).
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

/// Plans the stage's uniform items in order, except for items that need an aggregate. The plan is a
/// single pass without field slots. It may have no results.
StepPlan plan_uniform_start(const Program& program, std::uint32_t stage);

/// Plans the starting values of all items that plan_uniform_start() does not compute. If a result
/// is uniform (Stage::uniform), all cells of its plane have the same value. If `frozen` varies, it
/// is stored as a number like other items. The plan reads the positions of crawling cells and does
/// not compute them.
StepPlan plan_start(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// Plans an explicit Euler step, with one result for each species. If `frozen` varies, it is a mask
/// slot. If `frozen` is uniform, kernels do not read it, and the time loop takes no steps while it
/// is true.
StepPlan plan_step(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// Plans a sweep of a time integrator. Result o·S + s is output o of species s, where S is the
/// number of species that the sweep writes. Formulas read input 0, which contains the items of the
/// stage (StageItem). The other inputs are read only in the cell itself.
StepPlan plan_sweep(const Program& program, std::uint32_t stage, const SweepForm& form,
                    const PlanOptions& options = {});

/// The form of an explicit Euler step.
SweepForm euler_form();

/// Plans only the rates, without the time step: one result for each species. Used to estimate
/// stability.
StepPlan plan_rates(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// Plans the formula that decides which cells are inside the mask of the domain: one result. The
/// domain must have a mask, and the program must have at least one stage.
StepPlan plan_mask(const Program& program);
/// Plans those step-invariants of a stage that take less time to read in every step than to
/// compute. There are none without PlanOptions::keeps_step_invariants. Result k is step-invariant
/// k. Every step reads it from a plane or, if it is the same in all cells, as a number.
StepPlan plan_step_invariants(const Program& program, std::uint32_t stage,
                              const PlanOptions& options);

/// The plans for the fixed value or slope at a side, as side_settings() of lang/calculus gives it.
/// On a surface, a slope is in units of the grid.
struct SidePlans {
    bool changes = false;  ///< Whether the value depends on t, step or species.
    StepPlan once;         ///< The step-invariants of the value, if the value changes.
    /// The value. If the value changes, the plan is a single pass, which reads planes only in the
    /// cell itself and does not depend on the cell's position.
    StepPlan each;
};
SidePlans plan_side(const Program& program, const SideSetting& setting, Side side,
                    std::uint32_t stage);

/// Plans formulas over the present state. A formula for a number has one result. A formula for a
/// colour has three: red, green and blue, nominally 0 … 1 but not clamped. Outside of the mask,
/// results are NaN unless they are the same in all cells.
StepPlan plan_view(const Program& program, std::span<const Formula* const> formulas,
                   std::uint32_t stage, const PlanOptions& options = {});
StepPlan plan_view(const Program& program, const Formula& formula, std::uint32_t stage);

/// Plans the values that quantities of a stage of cells get after a division: one result for each
/// item that gets a value. The formulas read the state of the new cells before this change. Random
/// numbers depend on the numbers of the new cells.
StepPlan plan_restarts(const Program& program, std::uint32_t stage);

/// Prints the expression graphs of every stage after each pass that changes them, for `--dump
/// graph`.
std::string describe_graphs(const Program& program);

/// Describes the passes of every stage and the reasons for them, for `--dump plan`.
std::string describe_plans(const Program& program);

}  // namespace cascade
