// Starts stages of crawling cells, and evaluates formulas in their cells.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/simulation/environment.h"
#include "run/simulation/stage_view.h"
#include "run/tissue/tissue_binding.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Returns the stage in the form that the functions of run/tissue use. The states must outlive the
/// result.
TissueStage tissue_stage(const Environment& environment, std::span<const StageState> states,
                         std::uint32_t stage);

/// Returns the number of cells of a system that fit into memory.
std::size_t most_cells_in_memory(const System& system, Precision precision);

/// Returns the largest distance d in any `over near(d)` of the stage's system and of `others`.
/// Returns 0 if there is none.
double widest_near(const StageView& view, std::span<const Formula* const> others = {});

/// Evaluates a plan in the cells of a stage, at the present state. If the plan is not one of the
/// system's own plans, `formulas` are its formulas. All values are NaN if there are too many
/// neighbours, but a run of the stage would have been refused in this case.
std::vector<Field> evaluate_in_cells(const StageView& view, const StepPlan& plan,
                                     std::span<const Formula* const> formulas = {});

/// Returns the surface of the body on which the cells of a stage crawl, in the script's unit of
/// length. Returns null if there is no body.
std::shared_ptr<const SurfaceMesh> body_under_cells(const StageState& state);

/// Makes the cells of a stage from its founders or from the previous stage of cells, and computes
/// their values. Fails if no cell is left, if there are too many cells, or if `cancel` becomes true
/// while a body is made.
Result<void> start_tissue(const Environment& environment, std::span<StageState> states,
                          std::uint32_t stage, const std::atomic<bool>& cancel);

/// Returns the values that the start of a started stage would give to its present cells at their
/// present positions, by item and then in ascending order of the cells' numbers. An item has no
/// values if the start does not compute it or if it is uniform. The whole result is empty if the
/// start reads the cells of an earlier stage, because that stage has no values for cells that were
/// born later.
std::vector<std::vector<double>> values_of_start(const StageView& view);

/// Removes the cells in which `chosen` is not 0. Returns the number of remaining cells. If all
/// cells are chosen, removes no cell and returns 0.
std::size_t remove_cells(Tissue& tissue, const Field& chosen);

}  // namespace cascade
