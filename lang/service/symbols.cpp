// Builds the outline. A quantity is a species if it has a rate in its block.
#include "lang/service/symbols.h"

#include <algorithm>

namespace cascade {
namespace {

bool is_rate(const ast::Statement& statement) {
    return statement.kind == ast::StatementKind::rate ||
           statement.kind == ast::StatementKind::rate_term;
}

NameKind kind_of(const ast::Block& block, const ast::Statement& statement) {
    if (statement.kind == ast::StatementKind::definition) return NameKind::definition;
    if (block.kind != ast::BlockKind::system && block.kind != ast::BlockKind::shape)
        return NameKind::setting;
    const bool has_rate = std::ranges::any_of(block.statements, [&](const ast::Statement& other) {
        return is_rate(other) && other.name.text == statement.name.text;
    });
    return has_rate ? NameKind::species : NameKind::parameter;
}

/// The span of a block. The tree has no span for a classic stage, so the span is computed from the
/// parts of the stage.
Span span_of(const ast::Block& block) {
    if (block.span.end > 0) return block.span;
    Span span = block.keyword.span;
    if (!block.base.empty()) span = join(span, block.base.span);
    for (const ast::Statement& statement : block.statements)
        span.end = std::max(span.end, statement.span.end);
    return span;
}

Symbol symbol_of(const ast::Block& block) {
    const ast::Word& word = block.name.empty() ? block.keyword : block.name;
    Symbol symbol{std::string(word.text), NameKind::keyword, word.span, span_of(block), {}};
    switch (block.kind) {
        case ast::BlockKind::system: symbol.kind = NameKind::system; break;
        case ast::BlockKind::stage:
        case ast::BlockKind::classic_stage: symbol.kind = NameKind::stage; break;
        case ast::BlockKind::shape: symbol.kind = NameKind::shape; break;
        case ast::BlockKind::domain:
        case ast::BlockKind::picture: break;
    }
    for (const ast::Statement& statement : block.statements) {
        const bool declares = statement.kind == ast::StatementKind::value ||
                              statement.kind == ast::StatementKind::definition;
        if (!declares || statement.name.empty()) continue;
        symbol.inside.push_back({std::string(statement.name.text),
                                 kind_of(block, statement),
                                 statement.name.span,
                                 statement.span,
                                 {}});
    }
    return symbol;
}

}  // namespace

std::vector<Symbol> symbols_of(const ast::Script& tree, SourceId source) {
    std::vector<Symbol> symbols;
    for (const ast::Block& block : tree.blocks) {
        if (block.keyword.span.source == source) symbols.push_back(symbol_of(block));
    }
    for (const ast::FunctionDefinition& function : tree.functions) {
        if (function.name.empty() || function.name.span.source != source) continue;
        symbols.push_back({std::string(function.name.text),
                           NameKind::function,
                           function.name.span,
                           function.span,
                           {}});
    }
    std::ranges::sort(symbols, {}, [](const Symbol& symbol) { return symbol.span.begin; });
    return symbols;
}

}  // namespace cascade
