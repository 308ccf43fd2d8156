// How much memory a run needs, and whether it may have it.
#pragma once

#include "core/result.h"
#include "lang/program/models.h"
#include "run/stage/stage_plans.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The numbers of cells along the axes of a grid: "128 × 64", with slices "128 × 64 × 32".
std::string describe_sides(const Grid& grid);

/// Bytes of all planes that a run holds at one time; the plans are those that it will run. If a
/// model's cells are not made yet, `model` is null: then the number of cells is the one that the
/// script asks for, and planes for computing bounds of the step do not count.
double memory_of(const Program& program, StagePlans& plans, const ModelFacts* model = nullptr);
double memory_of(const Program& program);

/// Fails if a run that needs this number of bytes on this grid would not fit into `limit` bytes (0:
/// no limit) or into the free memory of the machine and of the container.
Result<void> check_memory(const Grid& grid, double needed, std::uint64_t limit = 0);

}  // namespace cascade
