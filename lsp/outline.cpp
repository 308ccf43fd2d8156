// The outline of a script, the parts of it that can be folded, and the files that it names.
#include "lang/service/symbols.h"
#include "lsp/answers.h"
#include "lsp/file_uri.h"
#include "lsp/kinds.h"

#include <algorithm>

namespace cascade::lsp {
namespace {

Json json_of(const Document& document, const Symbol& symbol) {
    // The range of a symbol must contain its name.
    const Span whole = join(symbol.span, symbol.name_span);
    Json json = {{"name", symbol.name},
                 {"kind", numbers_of(symbol.kind).symbol},
                 {"detail", name_of(symbol.kind)},
                 {"range", range_of(document, whole)},
                 {"selectionRange", range_of(document, symbol.name_span)}};
    for (const Symbol& inside : symbol.inside)
        json["children"].push_back(json_of(document, inside));
    return json;
}

/// The lines of a text that contain only a comment.
std::vector<bool> comment_lines(std::string_view text) {
    std::vector<bool> lines;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::size_t first = text.find_first_not_of(" \t", at);
        lines.push_back(first < end && text[first] == '#');
        at = end + 1;
    }
    return lines;
}

}  // namespace

Result<Json> symbols(const Asked& asked) {
    Json list = Json::array();
    for (const Symbol& symbol : symbols_of(asked.document.script().tree, own_source)) {
        if (!symbol.name.empty()) list.push_back(json_of(asked.document, symbol));
    }
    return list;
}

Result<Json> folding(const Asked& asked) {
    const Document& document = asked.document;
    Json list = Json::array();
    for (const Symbol& symbol : symbols_of(asked.document.script().tree, own_source)) {
        const auto first = document.lines().position_of(document.text(), symbol.span.begin);
        const auto last = document.lines().position_of(document.text(), symbol.span.end);
        if (last.line > first.line)
            list.push_back({{"startLine", first.line}, {"endLine", last.line}});
    }
    const std::vector<bool> is_comment = comment_lines(document.text());
    for (std::size_t line = 0; line < is_comment.size(); ++line) {
        if (!is_comment[line]) continue;
        std::size_t last = line;
        while (last + 1 < is_comment.size() && is_comment[last + 1]) ++last;
        if (last > line)
            list.push_back({{"startLine", line}, {"endLine", last}, {"kind", "comment"}});
        line = last;
    }
    return list;
}

/// Links to the files that exist, relative to the folder of the document.
Result<Json> links(const Asked& asked) {
    Document& document = asked.document;
    Json list = Json::array();
    if (!document.path()) return list;
    const std::filesystem::path folder = document.path()->parent_path();
    const auto add = [&](Span span, const std::string& name) {
        if (span.source != own_source || name.empty()) return;
        std::error_code error;
        const auto file = folder / name;
        if (!std::filesystem::is_regular_file(file, error)) return;
        list.push_back({{"range", range_of(document, span)}, {"target", uri_of_path(file)}});
    };
    const ast::Script& tree = document.script().tree;
    for (const ast::Use& use : tree.uses) add(use.span, use.path);
    for (const ast::Expr& expr : tree.expressions) {
        if (const auto* text = std::get_if<ast::Text>(&expr.node)) add(expr.span, text->value);
    }
    return list;
}

}  // namespace cascade::lsp
