// Lowering: formulas of a checked program to cell kernels. Cannot fail.
//
// A stage becomes: at its start `plan_uniform_start` computes the items that are the same
// everywhere (run on a grid of one cell) and the plan of its starting values those that vary; then
// the plan of a step computes the new value of every species from the old step:
//
//     new = old + speed · rate, clamped by the invariants in order of writing; old where frozen,
//
// or the plans of the sweeps of another integrator. Outside of the mask of the domain all items
// that vary are 0, at the start and after every step, and all rates are 0. The plan of a view
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

/// The stage's uniform items, in their order, but for those that need an aggregate. One pass
/// without field slots. May have no results.
StepPlan plan_uniform_start(const Program& program, std::uint32_t stage);

/// Starting values of all other items. A result that is uniform (Stage::uniform) is the same in all
/// cells of its plane. `frozen`, if it varies, is stored as a number like the others.
StepPlan plan_start(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// One explicit Euler step, one result per species. Where `frozen` varies it is a mask slot; where
/// it is the same everywhere it is not in the kernels at all, and the time loop takes no steps if
/// it is true.
StepPlan plan_step(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// One sweep of a time integrator: result o·S + s is output o of the s-th of S species written.
/// Formulas read input 0, which are the items of the stage (SlotSource::item); further inputs are
/// read in the own cell.
StepPlan plan_sweep(const Program& program, std::uint32_t stage, const SweepForm& form,
                    const PlanOptions& options = {});

/// The form of an explicit Euler step of `speed`.
SweepForm euler_form();

/// The rates alone, one result per species: dt-free right-hand sides, for stability.
StepPlan plan_rates(const Program& program, std::uint32_t stage, const PlanOptions& options = {});

/// What decides which cells are inside the mask of the domain, which must have one: one result.
/// Of a program with a stage.
StepPlan plan_mask(const Program& program);
/// What no step of the stage changes, as far as keeping it pays
/// (PlanOptions::keeps_step_invariants; without it nothing): result k is step-invariant part k,
/// which every step reads from a plane or, where it is the same in all cells, as a number.
StepPlan plan_step_invariants(const Program& program, std::uint32_t stage,
                              const PlanOptions& options);

/// The value of a side: of a flux on a surface in units of the grid.
struct SidePlans {
    bool changes = false;  ///< With t or step.
    StepPlan once;         ///< What does not change of one that does, as of plan_step_invariants.
    /// The value: of one that changes a single pass, which reads planes and numbers in the own cell
    /// and knows of no place.
    StepPlan each;
};
SidePlans plan_side(const Program& program, const SideSetting& setting, Side side,
                    std::uint32_t stage);

/// Formulas over the present state, one result each. A colour has three: red, green, blue, 0..1,
/// not clamped. Outside of the mask they are NaN where they are not the same in all cells.
StepPlan plan_view(const Program& program, std::span<const Formula* const> formulas,
                   std::uint32_t stage, const PlanOptions& options = {});
StepPlan plan_view(const Program& program, const Formula& formula, std::uint32_t stage);

/// The expression graphs of every stage after each pass of lowering that changes one, for
/// `--dump graph`.
std::string describe_graphs(const Program& program);

/// What the passes of every stage do and why, in words, for `--dump plan`.
std::string describe_plans(const Program& program);

}  // namespace cascade
