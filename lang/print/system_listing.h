// Lists the values of a system that users can set: species, parameters and settings. Each is listed
// with its default as the author wrote it, its range and its doc comment.
#pragma once

#include "core/source.h"
#include "lang/syntax/ast.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The description of a system: its doc comment and its texts (`title: "…"`), one line for each.
/// Descriptions of its bases come first.
std::vector<std::string> system_words(const ast::Script& script, const Sources& sources,
                                      std::string_view system);

/// A line for each species, then a line for each parameter, and then a line for each setting. The
/// system is found as in print_equations().
std::string print_system_listing(const ast::Script& script, const Sources& sources,
                                 std::string_view system);

}  // namespace cascade
