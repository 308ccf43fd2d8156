// Formulas as text (internal to lang/): resolved names, as few brackets as the precedences need.
#pragma once

#include "lang/program/program.h"

#include <optional>
#include <string>

namespace cascade {

/// A value of places on a model, as a script has it.
std::string text_of(const SurfaceValue& value);

/// The formula in the language itself, except that own items of a stage are [p], as in a stage's
/// statements, and items of other stages always stage.p. In formulas of a system (no `stage`) own
/// names are bare.
std::string print_formula(const Program& program, const System& system, const Formula& formula,
                          std::optional<std::uint32_t> stage = {});

}  // namespace cascade
