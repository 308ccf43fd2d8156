// Lists the values of a system that users can set: species, parameters and settings, with defaults
// as their author wrote them, ranges and doc comments.
#pragma once

#include "core/source.h"
#include "lang/syntax/ast.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The description of a system: its doc comment and its texts (`title: "…"`), one line each.
/// Descriptions of its bases come first.
std::vector<std::string> system_words(const ast::Script& script, const Sources& sources,
                                      std::string_view system);

/// A line for each species, then each parameter, then each setting. Finds the system as
/// print_equations() does.
std::string print_system_listing(const ast::Script& script, const Sources& sources,
                                 std::string_view system);

}  // namespace cascade
