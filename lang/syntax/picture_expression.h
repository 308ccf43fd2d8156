// A setting of the script's picture block, such as `color`, which is read before anything is
// checked.
#pragma once

#include "lang/syntax/ast.h"

#include <optional>
#include <string_view>

namespace cascade {

/// The value of a setting of the script's picture block, such as `color`, if it has one.
std::optional<ast::Expression> picture_expression(const ast::Script& script,
                                                  std::string_view setting = "color");

}  // namespace cascade
