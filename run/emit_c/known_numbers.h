// Values of parameters that are known before a run.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// By stage and item: the values of uniform items that can be computed without any field.
using KnownNumbers = std::vector<IdVector<ItemId, std::optional<float>>>;

/// For stages 0 … `last`.
KnownNumbers known_numbers(const Program& program, std::uint32_t last);

}  // namespace cascade
