// A system as a list of what can be set in it, for people: species, parameters and settings with
// their defaults as the author wrote them, ranges and doc comments.
#pragma once

#include "core/source.h"
#include "lang/syntax/ast.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// What a system says of itself in words: its doc comment and the texts among its statements
/// (`title: "…"`), a line each; those of the systems it is derived from come first.
std::vector<std::string> system_words(const ast::Script& script, const Sources& sources,
                                      std::string_view system);

/// A line for each species, then each parameter, then each setting. The system is looked for as
/// print_equations() does.
std::string print_system_listing(const ast::Script& script, const Sources& sources,
                                 std::string_view system);

}  // namespace cascade
