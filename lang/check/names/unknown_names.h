// Reports names that cannot be read where they are written (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

#include <string>
#include <string_view>

namespace cascade::checking {

/// Whether a built-in value can differ between cells. All built-in values can, except t and step.
inline bool varies_by_cell(std::string_view builtin) { return builtin != "t" && builtin != "step"; }

/// The text "'x' is not a parameter of s".
std::string not_a_parameter(std::string_view name, const System& system);

/// Reports a name in an expression that cannot read names of a system.
void report_constant(Workspace& work, const Scope& scope, std::string_view name, Span span);
/// Reports a name that the scope's system does not declare.
void report_unknown_own(Workspace& work, const Scope& scope, std::string_view name, Span span);
/// Reports a name that refers to the previous stage, although the name is in the first stage.
void report_first_stage(Workspace& work, const Scope& scope, std::string_view name, Span span);
/// Reports a name that the previous stage does not have.
void report_unknown_previous(Workspace& work, const Scope& scope, std::string_view name, Span span);

/// Reports that there is no system of this name.
void report_unknown_system(Workspace& work, const ast::Word& name);

/// Reports that there is no shape of this name.
void report_unknown_shape(Workspace& work, const ast::Script& script, const ast::Word& name);

}  // namespace cascade::checking
