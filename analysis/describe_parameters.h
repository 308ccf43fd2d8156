// Critical values of parameters, in words.
#pragma once

#include "analysis/parameters.h"

#include <string>

namespace cascade::analysis {

/// "decay = 7 (0.5 to 20): stable, Turing above 4.71 (9.62 cells), Hopf and Turing above 21.3".
std::string describe(const Program& program, std::uint32_t stage, const ParameterScan& scan);

/// The class in words, and "no flat state" without one.
std::string class_name(const std::optional<Stability>& stability);

}  // namespace cascade::analysis
