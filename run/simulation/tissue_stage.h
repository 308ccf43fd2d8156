// Stages of cells that crawl: their start, and what their formulas read.
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

/// The stage as the rooms below see it. The states must outlive it.
TissueStage tissue_stage(const Environment& environment, std::span<const StageState> states,
                         std::uint32_t stage);

/// The number of cells of a system for which there is memory.
std::size_t most_cells_in_memory(const System& system, Precision precision);

/// The largest distance of `over near(d)` in the formulas of a stage's system and in `others`; 0
/// without any.
double widest_near(const StageView& view, std::span<const Formula* const> others = {});

/// The values of a plan in the cells of a stage, at the present state; of `formulas` if these are
/// not the system's own. NaN if there are too many
/// neighbours, which a run of the stage would have refused.
std::vector<Field> evaluate_in_cells(const StageView& view, const StepPlan& plan,
                                     std::span<const Formula* const> formulas = {});

/// The surface of the body on which the cells of a stage crawl, in lengths of scripts; null without
/// one.
std::shared_ptr<const SurfaceMesh> body_under_cells(const StageState& state);

/// A remark on a stage of cells that has ended, or nothing.
std::string remark_on_cells(const StageView& view);

/// Makes the cells of a stage from its founders, or from those of the stage of cells before it, and
/// computes their values. Fails if no cell is left, if there are too many, and when `cancel`
/// becomes true while a body is made.
Result<void> start_tissue(const Environment& environment, std::span<StageState> states,
                          std::uint32_t stage, const std::atomic<bool>& cancel);

/// The values that the start of a started stage would give its present cells where they are now:
/// by item, then in ascending order of the cells' numbers. Empty for items that the start does not
/// compute, or that are the same in all cells. Empty altogether if the start reads cells of an
/// earlier stage, of which cells born since have no values.
std::vector<std::vector<double>> values_of_start(const StageView& view);

/// Removes the cells where `chosen`, a value in each of them, is not 0. Returns the number of cells
/// that stay; if that is 0, all were chosen, and none is removed.
std::size_t remove_cells(Tissue& tissue, const Field& chosen);

}  // namespace cascade
