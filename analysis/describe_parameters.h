// Describes critical values of parameters.
#pragma once

#include "analysis/parameters.h"

#include <string>

namespace cascade::analysis {

/// A line of text such as "decay = 7 (0.5 to 20): stable, Turing above 4.71 (9.62 cells), Hopf and
/// Turing above 21.3".
std::string describe(const Program& program, std::uint32_t stage, const ParameterScan& scan);

/// The name of the class for users, or "no flat state" if there is no class.
std::string class_name(const std::optional<Stability>& stability);

}  // namespace cascade::analysis
