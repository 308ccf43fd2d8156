// Finds the waves that grow in a growing domain, at several times of a stage.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <string>

namespace cascade::analysis {

/// Describes a stage at several times, in lines of text: the lengths of the domain at a time, and
/// how many of the waves that fit along x then grow from the flat state. Empty if lengths do not
/// change or if the stage's duration is not known before the run.
std::string waves_of_growing_domain(const Program& program, std::uint32_t stage);

}  // namespace cascade::analysis
