// Finds a setting in a script's picture block.
#include "lang/syntax/picture_expression.h"

namespace cascade {

std::optional<ast::Expression> picture_expression(const ast::Script& script,
                                                  std::string_view setting) {
    for (const ast::Block& block : script.blocks) {
        if (block.kind != ast::BlockKind::picture) continue;
        for (const ast::Statement& statement : block.statements) {
            const bool is_sought = statement.kind == ast::StatementKind::value &&
                                   statement.name.text == setting && !statement.values.empty();
            if (is_sought) return statement.values[0];
        }
    }
    return std::nullopt;
}

}  // namespace cascade
