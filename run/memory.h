// How much memory a run takes, and whether that may be.
#pragma once

#include "core/result.h"
#include "lang/program.h"

#include <cstdint>
#include <string>

namespace cascade {

/// "3.2 GB", "40.5 MB".
std::string describe_bytes(double bytes);

/// Bytes of all planes that a run keeps at one time.
double memory_of(const Program& program);

/// Bytes that the system would give without swapping; 0 where it does not say.
std::uint64_t available_memory();

/// Fails if the fields of all stages would not fit into `limit` bytes (0: no limit but the machine)
/// or into the machine's free memory.
Result<void> check_memory(const Program& program, std::uint64_t limit = 0);

}  // namespace cascade
