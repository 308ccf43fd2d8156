// The waves that grow in a domain that grows itself, at several times of a stage.
#pragma once

#include "lang/program/program.h"

#include <cstdint>
#include <string>

namespace cascade::analysis {

/// For some times of a stage, the lengths of the domain and how many waves that fit along x grow
/// from the flat state of that time, as lines of text. Empty if lengths do not change or if the
/// stage's duration is not known before the run.
std::string waves_of_growing_domain(const Program& program, std::uint32_t stage);

}  // namespace cascade::analysis
