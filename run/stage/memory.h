// How much memory a run takes, and whether that may be.
#pragma once

#include "core/result.h"
#include "lang/program/models.h"
#include "run/stage/stage_plans.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The cells along the axes of a grid: "128 × 64", with slices "128 × 64 × 32".
std::string describe_sides(const Grid& grid);

/// Bytes of all planes that a run keeps at one time. The plans are those that it will run. Of a
/// model whose cells are not made yet, `model` is null: then there are as many as the script asks
/// for, and the planes that bounds of the step are computed in do not count.
double memory_of(const Program& program, StagePlans& plans, const ModelFacts* model = nullptr);
double memory_of(const Program& program);

/// Fails if a run on this grid that needs this number of bytes would not fit into `limit` bytes (0:
/// no limit but the machine) or into the free memory of the machine and of the container.
Result<void> check_memory(const Grid& grid, double needed, std::uint64_t limit = 0);

}  // namespace cascade
