// Formulas as text (internal to lang/), with resolved names and as few brackets as precedences
// allow.
#pragma once

#include "lang/program/program.h"

#include <optional>
#include <string>

namespace cascade {

/// Writes a value of a model's surface in the notation of scripts.
std::string text_of(const SurfaceValue& value);

/// The formula in the notation of scripts. If `stage` is given, items of this stage are written as
/// [p], and items of other stages as stage.p, as in the statements of this stage. Otherwise the
/// names of the system are written without brackets or prefix.
std::string print_formula(const Program& program, const System& system, const Formula& formula,
                          std::optional<std::uint32_t> stage = {});

}  // namespace cascade
