// Formulas as text (internal to lang/): resolved names, as few brackets as the precedences allow.
#pragma once

#include "lang/program/program.h"

#include <optional>
#include <string>

namespace cascade {

/// A value of a model's surface, as written in a script.
std::string text_of(const SurfaceValue& value);

/// The formula in the language itself. With a `stage`, its own items are [p], as in its statements,
/// and items of other stages are stage.p. Without one, names of the system are bare.
std::string print_formula(const Program& program, const System& system, const Formula& formula,
                          std::optional<std::uint32_t> stage = {});

}  // namespace cascade
