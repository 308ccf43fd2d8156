// Checks of systems, and of the settings that systems and stages share (internal to the checker).
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/names/check_names.h"
#include "lang/check/systems/system_inheritance.h"

#include <optional>
#include <vector>

namespace cascade::checking {

/// Checks a system or a block of cells; `base` is the one it is derived from, and `joined` are the
/// further ones. A system with errors is added, too, so
/// that its readers do not cause further messages; one whose base is unknown is not
/// (unknown_system).
SystemId check_system(Workspace& work, const DerivedSystem& derived, std::optional<SystemId> base,
                      std::vector<SystemId> joined);

/// If the declaration is a text of the system, such as title: "Gray-Scott", takes it and returns
/// true.
bool take_text(System& system, const Declaration& declaration);

/// Sets the range of a quantity whose declaration has one; `value` is its default, if known.
void check_range(Workspace& work, const Declaration& declaration, Quantity& quantity,
                 std::optional<double> value);

/// Warns of a constant value outside of the parameter's range.
void warn_outside(Workspace& work, const Quantity& quantity, std::optional<double> value,
                  Span span);

/// Warns of parameters and definitions that nothing reads. In a derived system, a
/// statement that changes nothing of its base and is not read is an error.
void warn_unread(Workspace& work);

// Settings of systems and stages.

/// Applies one of the settings iterations, interval, frozen, speed and show, or
/// one of time.
void check_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                   const Scope& scope, Settings& settings);

}  // namespace cascade::checking
