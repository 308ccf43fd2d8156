// How much memory a run takes, and whether that may be.
#pragma once

#include "core/result.h"
#include "lang/program/program.h"
#include "run/stage/stage_plans.h"

#include <cstdint>
#include <string>

namespace cascade {

/// The cells along the axes of a grid: "128 × 64", with slices "128 × 64 × 32".
std::string describe_sides(const Grid& grid);

/// Bytes of all planes that a run keeps at one time. The plans are those that it will run.
double memory_of(const Program& program, StagePlans& plans);
double memory_of(const Program& program);

/// Fails if a run on this grid that needs so many bytes would not fit into `limit` bytes (0: no limit
/// but the machine) or into the free memory of the machine and of the container.
Result<void> check_memory(const Grid& grid, double needed, std::uint64_t limit = 0);

}  // namespace cascade
