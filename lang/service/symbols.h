// The outline of a script: its blocks and their declarations.
#pragma once

#include "core/source.h"
#include "lang/service/known_names.h"
#include "lang/syntax/ast.h"

#include <string>
#include <vector>

namespace cascade {

struct Symbol {
    std::string name;  ///< The declared name; `domain` or `picture` for these two blocks.
    NameKind kind = NameKind::keyword;
    /// The position of the name, and of the whole block, function or statement.
    Span name_span, span;
    std::vector<Symbol> inside;
};

/// The blocks and functions of one source of a tree, in the order of the text.
std::vector<Symbol> symbols_of(const ast::Script& tree, SourceId source);

}  // namespace cascade
