// The values of parameters that are known before anything runs.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// By stage and item: the values, as far as they are known without any field, of all items that are
/// the same in all cells.
using KnownNumbers = std::vector<std::vector<std::optional<float>>>;

/// Of stages 0 … `last`.
KnownNumbers known_numbers(const Program& program, std::uint32_t last);

}  // namespace cascade
