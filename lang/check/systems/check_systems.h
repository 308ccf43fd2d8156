// Checks of systems, and of the settings that systems and stages share (internal to the checker).
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/names/check_names.h"
#include "lang/check/systems/system_inheritance.h"

#include <optional>
#include <vector>

namespace cascade::checking {

/// Checks a system or a block of cells. `base` is the system from which it is derived, and `joined`
/// are further bases. A system with errors is added, too, so that expressions that read its names
/// cause no further messages. If the base of the system is unknown, adds nothing and returns
/// unknown_system.
SystemId check_system(Workspace& work, const DerivedSystem& derived, std::optional<SystemId> base,
                      std::vector<SystemId> joined);

/// If the declaration is a text about the system, such as title: "Gray-Scott", stores the text and
/// returns true.
bool take_text(System& system, const Declaration& declaration);

/// Sets the range of a quantity if its declaration has a range. `value` is the default of the
/// quantity, if the default is known.
void check_range(Workspace& work, const Declaration& declaration, Quantity& quantity,
                 std::optional<double> value);

/// Warns if a constant value is outside the range of its parameter.
void warn_outside(Workspace& work, const Quantity& quantity, std::optional<double> value,
                  Span span);

/// Warns of parameters and definitions that nothing reads. If a derived system declares an unread
/// name that its base does not declare, this is an error.
void warn_unread(Workspace& work);

// Settings that both systems and stages have.

/// Applies a setting: iterations, interval, frozen, speed, show, or a setting of time.
void check_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                   const Scope& scope, Settings& settings);

}  // namespace cascade::checking
