// Lists the values of a system. Reads them from the syntax tree, so values are printed as their
// author wrote them.
#include "lang/print/system_listing.h"

#include "lang/library/system_statements.h"
#include "lang/format/format_words.h"
#include "lang/syntax/kept_spellings.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace cascade {

namespace {

struct Row {
    std::string_view kind;
    std::string name, value, range;
    std::string_view doc;
};

/// The source text of a value, put on one line.
std::string source_of(const SaidStatement& said, const ast::Expression& value) {
    const ast::Expr& root = said.script->expressions[value.root];
    const std::string_view text = said.sources->text(root.span);
    const auto* const number = std::get_if<ast::Number>(&root.node);
    if (number != nullptr && !is_spelling_of_number(text)) return fmt::format("{}", number->value);
    std::string line;
    for (const char c : text) {
        const bool is_blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (!is_blank) line += c;
        else if (!line.ends_with(' ')) line += ' ';
    }
    return line;
}

const ast::Text* text_of(const SaidStatement& said) {
    const ast::ExprId root = said.statement->values.front().root;
    return std::get_if<ast::Text>(&said.script->expressions[root].node);
}

Row row_of(const SaidStatement& said, const SystemStatements& system) {
    const ast::Statement& statement = *said.statement;
    const std::string_view name = statement.name.text;
    const bool is_of_cells = system.is_cells() && is_setting_of(SettingBlock::cells, name);
    const bool is_setting =
        statement.index.empty() && (is_of_cells || reserved(name) != Reserved::no);
    Row row;
    row.kind = is_setting ? "setting" : system.is_species(name) ? "species" : "parameter";
    row.name = statement.index.empty() ? std::string(name)
                                       : fmt::format("{}[{}]", name, statement.index.text);
    row.value = source_of(said, statement.values.front());
    if (statement.kind == ast::StatementKind::value) {
        for (std::size_t k = 1; k < statement.values.size(); ++k) {
            row.value += ", " + source_of(said, statement.values[k]);
        }
    }
    if (statement.kind == ast::StatementKind::index) {
        row.kind = "index";
        row.value += " .. " + source_of(said, statement.values.back());
    }
    if (!statement.after.empty()) row.value += fmt::format(" after {}", statement.after.text);
    if (said.range != nullptr) {
        const SaidStatement from{said.range_script, said.range_sources, said.range};
        const ast::Range& range = *said.range->range;
        row.range =
            fmt::format("in {} .. {}", source_of(from, range.low), source_of(from, range.high));
        if (range.step) row.range += " step " + source_of(from, *range.step);
    }
    if (said.doc != nullptr) row.doc = said.doc->doc;
    return row;
}

std::string padded(std::string_view text, std::size_t width) {
    const std::size_t own = width_of(text);
    return std::string(text) + std::string(width > own ? width - own : 0, ' ');
}

}  // namespace

std::vector<std::string> system_words(const ast::Script& script, const Sources& sources,
                                      std::string_view system) {
    const SystemStatements statements(script, sources, system_blocks(script), system);
    std::vector<std::string> lines;
    if (!statements.doc().empty()) lines.push_back(statements.doc());
    for (const SaidStatement& said : statements.all()) {
        if (said.statement->kind != ast::StatementKind::value) continue;
        if (const ast::Text* text = text_of(said)) lines.push_back(text->value);
    }
    return lines;
}

std::string print_system_listing(const ast::Script& script, const Sources& sources,
                                 std::string_view system) {
    // If a value is wider than this, the columns after it are shifted.
    constexpr std::size_t widest_value = 24;
    const SystemStatements statements(script, sources, system_blocks(script), system);
    std::vector<Row> rows;
    std::size_t name_width = 0, value_width = 0, range_width = 0;
    for (const SaidStatement& said : statements.all()) {
        const bool is_listed = said.statement->kind == ast::StatementKind::value ||
                               said.statement->kind == ast::StatementKind::index;
        if (!is_listed || text_of(said) != nullptr) continue;
        rows.push_back(row_of(said, statements));
        name_width = std::max(name_width, width_of(rows.back().name));
        const std::size_t width = width_of(rows.back().value);
        if (width <= widest_value) value_width = std::max(value_width, width);
        range_width = std::max(range_width, width_of(rows.back().range));
    }
    std::string text;
    for (const std::string_view kind : {"index", "species", "parameter", "setting"}) {
        for (const Row& row : rows) {
            if (row.kind != kind) continue;
            std::string line = fmt::format("  {:<9} {} {}", kind, padded(row.name, name_width),
                                           padded(row.value, value_width));
            if (range_width > 0) line += "  " + padded(row.range, range_width);
            if (!row.doc.empty()) line += fmt::format("  {}", row.doc);
            line.erase(line.find_last_not_of(' ') + 1);
            text += line + '\n';
        }
    }
    return text;
}

}  // namespace cascade
