// Writes the C header for the object file of a compiled stage.
#pragma once

#include "lang/program/program.h"
#include "run/emit_c/c_stage.h"

#include <string>

namespace cascade {

/// Writes a self-contained header in plain C99. It has a struct with the stage's planes and
/// numbers. The functions of the header give the struct its layout in memory, compute the starting
/// values and take steps. A comment in the header describes all tables. `script` is the name of the
/// source file.
std::string c_header(const Program& program, std::uint32_t stage, const CStage& compiled,
                     const std::string& script);

}  // namespace cascade
