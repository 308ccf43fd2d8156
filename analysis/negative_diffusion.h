// Finds diffusion that makes differences grow. With such diffusion no time step is short enough.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cascade::analysis {

/// A message such as "v has a negative diffusion coefficient, -0.08: …". It names the first species
/// whose coefficient is the same negative number in all cells and at all times, and whose short
/// waves no higher power of lap damps. Empty if there is no such species, or if the coefficient is
/// not known before the run.
std::optional<std::string> negative_diffusion(const Program& program, std::uint32_t stage);

}  // namespace cascade::analysis
