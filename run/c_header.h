// The C header beside a compiled step.
#pragma once

#include "lang/lower.h"
#include "lang/program.h"

#include <string>

namespace cascade {

/// A header, complete by itself, that documents and wraps the compiled step kernel `NAME_rows`:
/// layout constants, halo fill, the order of species, planes and numbers, rounding, and
/// `NAME_step`, which does one whole step. Plain C99.
std::string c_header(const Program& program, std::uint32_t stage, const BoundKernel& bound,
                     const std::string& name, const std::string& script);

}  // namespace cascade
