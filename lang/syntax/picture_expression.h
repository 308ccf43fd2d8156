// Reads a setting of the script's picture block, such as `color`, before anything is checked.
#pragma once

#include "lang/syntax/ast.h"

#include <optional>
#include <string_view>

namespace cascade {

/// The value of this setting in the script's picture block. nullopt if the block does not contain
/// the setting.
std::optional<ast::Expression> picture_expression(const ast::Script& script,
                                                  std::string_view setting = "color");

}  // namespace cascade
