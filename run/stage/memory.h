// Computes how much memory a run needs, and refuses a run that would not fit.
#pragma once

#include "core/result.h"
#include "lang/program/models.h"
#include "run/stage/stage_plans.h"

#include <cstdint>
#include <string>

namespace cascade {

/// Returns the numbers of cells along the axes of a grid, such as "128 × 64", or "128 × 64 × 32"
/// with slices.
std::string describe_sides(const Grid& grid);

/// Returns the bytes of all planes that a run holds at one time. `plans` are the plans that will
/// run. If the cells of a model are not made yet, `model` is null. The number of cells is then the
/// number that the script gives, and planes for computing bounds of the step are not counted.
double memory_of(const Program& program, StagePlans& plans, const ModelFacts* model = nullptr);
double memory_of(const Program& program);

/// Fails if `needed` bytes exceed `limit` or the free memory of the machine or the container. A
/// limit of 0 means no limit. Messages name the grid.
Result<void> check_memory(const Grid& grid, double needed, std::uint64_t limit = 0);

}  // namespace cascade
