// What is said of names that cannot be read where they are written (internal to the checker).
#pragma once

#include "lang/check/names/check_names.h"

#include <string>
#include <string_view>

namespace cascade::checking {

/// Does a built-in value differ between cells? Only t and step do not.
inline bool varies_by_cell(std::string_view builtin) { return builtin != "t" && builtin != "step"; }

/// "'x' is not a parameter of s"
std::string not_a_parameter(std::string_view name, const System& system);

/// Reports a name where an expression cannot read the names of a system.
void report_constant(Workspace& work, const Scope& scope, std::string_view name, Span span);
/// Reports a name that the system of the scope lacks.
void report_unknown_own(Workspace& work, const Scope& scope, std::string_view name, Span span);
/// Reports a name of the previous stage in the first one.
void report_first_stage(Workspace& work, const Scope& scope, std::string_view name, Span span);
/// Reports a name that the previous stage lacks.
void report_unknown_previous(Workspace& work, const Scope& scope, std::string_view name, Span span);

/// Reports that there is no system of this name.
void report_unknown_system(Workspace& work, const ast::Word& name);

/// Reports that there is no shape of this name.
void report_unknown_shape(Workspace& work, const ast::Script& script, const ast::Word& name);

}  // namespace cascade::checking
