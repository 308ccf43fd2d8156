// Parses blocks: `system`, `stage`, `shape`, `domain`, `picture`, and the stages of classic
// programs.
#include "lang/syntax/script_parser.h"

#include "core/near_name.h"
#include "lang/syntax/second_rates.h"
#include "lang/vocabulary/settings.h"

#include <fmt/core.h>

#include <array>
#include <utility>

namespace cascade {

namespace {

ast::BlockKind kind_of_keyword(std::string_view keyword) {
    if (keyword == "system" || keyword == "cells") return ast::BlockKind::system;
    if (keyword == "stage") return ast::BlockKind::stage;
    if (keyword == "shape") return ast::BlockKind::shape;
    return keyword == "domain" ? ast::BlockKind::domain : ast::BlockKind::picture;
}

/// The words that describe a kind of block with a name and a base in messages.
struct HeaderWords {
    std::string_view nameless, base, named_form, derived_form;
};

HeaderWords header_words(const ast::Block& block) {
    if (block.kind == ast::BlockKind::shape) {
        return {"this shape has no name", "another shape", "write 'shape NAME {'",
                "write 'shape NAME: SHAPE {'"};
    }
    if (block.is_cells) {
        return {"these cells have no name", "other cells", "write 'cells NAME {'",
                "write 'cells NAME: CELLS {'"};
    }
    return {"this system has no name", "a system", "write 'system NAME {'",
            "write 'system NAME: SYSTEM {'"};
}

}  // namespace

void ScriptParser::parse_script() {
    while (!cursor_.at_end()) parse_item();
}

void ScriptParser::parse_item() {
    if (cursor_.take_if(TokenKind::newline) || cursor_.take_if(TokenKind::semicolon)) return;
    if (cursor_.at(TokenKind::close_curly)) {
        const Token close = cursor_.take();
        if (forgiven_closings_ > 0) {
            --forgiven_closings_;
        } else {
            cursor_.error(close.span, "this '}' closes nothing");
        }
        return;
    }
    // Outside of blocks, a name after the word `cells` or `shape` shows that the word begins a
    // block and is not a quantity.
    const bool begins_named = !in_classic_stage_ && cursor_.kind(1) == TokenKind::name &&
                              (cursor_.at_name("cells") || cursor_.at_name("shape"));
    if (cursor_.begins_block() || begins_named) return parse_block(cursor_.text(cursor_.peek()));
    if (begins_classic_stage()) return parse_classic_stage();
    if (parse_function_or_use() || parse_misspelt_block()) return;
    if (!in_classic_stage_) return parse_outside_statement();
    if (auto statement = parse_statement()) {
        add_statement(script_.blocks.back(), std::move(*statement));
    }
}

/// Parses a block with a misspelt keyword, such as `System s {`, as the block that was probably
/// intended, so that nothing else seems to be missing.
bool ScriptParser::parse_misspelt_block() {
    if (!cursor_.at(TokenKind::name) || !has_shape_of_block(1)) return false;
    const std::string meant = report_no_block(cursor_.word(cursor_.peek()));
    if (meant.empty()) {
        cursor_.skip_statement();
    } else {
        parse_block(meant);
    }
    return true;
}

/// Parses the block that begins at the cursor. `keyword` is the keyword that was intended, even if
/// it is misspelt in the script.
void ScriptParser::parse_block(std::string_view keyword) {
    in_classic_stage_ = false;
    outside_reported_ = false;
    ast::Block block;
    block.doc = docs_before();
    block.keyword = cursor_.word(cursor_.take());
    block.kind = kind_of_keyword(keyword);
    block.is_cells = keyword == "cells";
    if (block.kind == ast::BlockKind::system || block.kind == ast::BlockKind::shape) {
        parse_header_of_system(block);
    } else if (block.kind == ast::BlockKind::stage) {
        parse_header_of_stage(block);
    } else {
        parse_header_without_name();
    }
    parse_body(block);
    complete_second_rates(script_, block);
    block.span = join(block.keyword.span, cursor_.previous().span);
    script_.blocks.push_back(std::move(block));
}

/// Parses the header of a system, cells or a shape: NAME or NAME: BASE. Cells may have several
/// bases: NAME: BASE, BASE.
void ScriptParser::parse_header_of_system(ast::Block& block) {
    if (cursor_.at(TokenKind::name)) {
        block.name = cursor_.word(cursor_.take());
    } else {
        const HeaderWords words = header_words(block);
        cursor_.error(block.keyword.span, std::string(words.nameless),
                      std::string(words.named_form));
        block.is_damaged = true;
    }
    if (cursor_.at(TokenKind::colon)) parse_bases(block);
}

/// Parses the bases after a colon: BASE { , BASE }.
void ScriptParser::parse_bases(ast::Block& block) {
    while (cursor_.at(TokenKind::colon) || cursor_.at(TokenKind::comma)) {
        const Token sign = cursor_.take();
        if (sign.kind == TokenKind::comma && !block.is_cells) {
            const bool is_shape = block.kind == ast::BlockKind::shape;
            cursor_.error(sign.span,
                          is_shape ? "a shape can have only one base"
                                   : "a system can have only one base",
                          "only blocks of cells can have several bases");
        }
        if (!cursor_.at(TokenKind::name)) {
            if (cursor_.at(TokenKind::garbage) || cursor_.at(TokenKind::newline)) return;
            const HeaderWords words = header_words(block);
            return cursor_.error(sign.span,
                                 fmt::format("the name of {} is missing after {}", words.base,
                                             cursor_.describe(sign)),
                                 std::string(words.derived_form));
        }
        const ast::Word base = cursor_.word(cursor_.take());
        if (block.name.empty()) continue;  // The missing name has been reported.
        if (sign.kind == TokenKind::colon) {
            block.base = base;
        } else if (block.is_cells) {
            block.joined.push_back(base);
        }
    }
}

/// Parses the header of a stage: NAME: SYSTEM.
void ScriptParser::parse_header_of_stage(ast::Block& block) {
    const std::string form = "write 'stage NAME: SYSTEM {'";
    bool is_told = false;
    if (cursor_.at(TokenKind::name)) {
        block.name = cursor_.word(cursor_.take());
    } else {
        cursor_.error(block.keyword.span, "this stage has no name", form);
        is_told = true;
    }
    const bool has_colon = cursor_.take_if(TokenKind::colon);
    const std::string name = "'" + shortened(block.name.text) + "'";
    if (cursor_.at(TokenKind::name)) {
        if (!has_colon && !is_told) {
            cursor_.error(block.name.span, fmt::format("':' is missing after {}", name), form);
        }
        block.base = cursor_.word(cursor_.take());
    } else if (!is_told && !cursor_.at(TokenKind::garbage)) {
        cursor_.error(has_colon ? cursor_.previous().span : block.name.span,
                      fmt::format("stage {} does not name its system", name), form);
        block.is_damaged = true;
    }
}

/// Parses the header of `domain` or `picture`. These blocks have no name.
void ScriptParser::parse_header_without_name() {
    const Token keyword = cursor_.previous();
    if (!cursor_.at(TokenKind::name) && !cursor_.at(TokenKind::colon)) return;
    const Token extra = cursor_.take();
    cursor_.error(extra.span,
                  fmt::format("{} has no place after {}", cursor_.describe(extra),
                              cursor_.describe(keyword)),
                  fmt::format("write '{} {{'", cursor_.text(keyword)));
}

/// A hint about the token at the cursor, which should be the '{' of a block.
std::string ScriptParser::hint_of_missing_bracket(const Token& header_end) const {
    if (cursor_.at(TokenKind::minus) && cursor_.kind(1) == TokenKind::name) {
        return fmt::format("names have no '-': write '{}_{}'", cursor_.text(header_end),
                           cursor_.text(cursor_.peek(1)));
    }
    if (cursor_.at(TokenKind::open_round)) return "systems have no '( )': leave it out";
    return "a block is written { statements }";
}

/// Parses { statements }. If the closing bracket is missing, the block ends where the next block
/// begins.
void ScriptParser::parse_body(ast::Block& block) {
    const Token header_end = cursor_.previous();
    cursor_.skip_newlines();
    const bool is_open = cursor_.at(TokenKind::open_curly);
    const Token open = cursor_.peek();
    if (is_open) {
        cursor_.take();
        add_docs(block.doc, docs_after(block.keyword.span.begin));
    } else if (cursor_.at(TokenKind::garbage)) {
        block.is_damaged = true;
        cursor_.skip_statement();
    } else {
        // Whether an error in the header has been reported already, because the header ended too
        // early.
        const bool is_told = block.is_damaged && !cursor_.at(TokenKind::name);
        block.is_damaged = true;
        if (!is_told) {
            cursor_.error(header_end.span,
                          fmt::format("'{{' is missing after {}", cursor_.describe(header_end)),
                          hint_of_missing_bracket(header_end));
        }
        // Skips the rest of the header's line, which is not a statement.
        if (header_end.kind != TokenKind::name || !cursor_.at(TokenKind::name)) {
            cursor_.skip_statement();
        }
    }
    while (!cursor_.at_end() && !cursor_.begins_block() && !begins_classic_stage()) {
        if (cursor_.take_if(TokenKind::close_curly)) return;
        if (cursor_.take_if(TokenKind::newline) || cursor_.take_if(TokenKind::semicolon)) continue;
        if (refuse_function_or_use()) {
            block.is_damaged = true;
            continue;
        }
        if (auto statement = parse_statement()) {
            add_statement(block, std::move(*statement));
        } else {
            block.is_damaged = true;
        }
    }
    if (!is_open) return;
    block.is_damaged = true;
    if (!cursor_.lost_in_text(open, "}")) report_unclosed(open, block);
}

void ScriptParser::report_unclosed(const Token& open, const ast::Block& block) {
    Diagnostic diagnostic;
    diagnostic.span = open.span;
    diagnostic.message = "this '{' is never closed";
    const std::string name = block.name.empty() ? "" : " '" + shortened(block.name.text) + "'";
    diagnostic.hint = fmt::format("{}{} ends with '}}'", block.keyword.text, name);
    if (!cursor_.at_end()) {
        diagnostic.notes.push_back({cursor_.peek().span, "the next block begins here"});
        // The next block was probably meant to be inside this block, so a '}' follows later.
        ++forgiven_closings_;
    }
    cursor_.error(std::move(diagnostic));
}

/// Parses `system_name: SYSTEM` and all statements before the next `system_name` or block.
void ScriptParser::parse_classic_stage() {
    ast::Block block;
    block.kind = ast::BlockKind::classic_stage;
    block.doc = docs_before();
    block.keyword = cursor_.word(cursor_.take());
    in_classic_stage_ = true;
    outside_reported_ = false;
    parse_base_of_classic_stage(block);
    add_docs(block.doc, docs_after(block.keyword.span.begin));
    script_.blocks.push_back(std::move(block));
}

void ScriptParser::parse_base_of_classic_stage(ast::Block& block) {
    const std::string form = "write 'system_name: SYSTEM'";
    const bool has_colon = cursor_.take_if(TokenKind::colon);
    if (!has_colon && !cursor_.at(TokenKind::garbage)) {
        cursor_.error(block.keyword.span, "':' is missing after 'system_name'", form);
        cursor_.take_if(TokenKind::assign);
    }
    if (cursor_.at(TokenKind::name)) {
        block.base = cursor_.word(cursor_.take());
    } else if (has_colon && !cursor_.at(TokenKind::garbage)) {
        const bool is_missing = cursor_.at_statement_end();
        cursor_.error(is_missing ? cursor_.previous().span : cursor_.peek().span,
                      is_missing ? "the name of a system is missing"
                                 : fmt::format("{} is not the name of a system",
                                               cursor_.describe(cursor_.peek())),
                      form);
    }
    if (cursor_.at_statement_end()) return;
    const bool is_told = !has_colon || block.base.empty() || cursor_.at(TokenKind::garbage);
    if (!is_told) {
        cursor_.error(cursor_.peek().span, fmt::format("{} has no place after the name of a system",
                                                       cursor_.describe(cursor_.peek())));
    }
    cursor_.skip_statement();
}

/// Parses a statement outside of all stages, to report the errors in it, and drops it.
void ScriptParser::parse_outside_statement() {
    const bool is_name = cursor_.at(TokenKind::name);
    const std::size_t errors_before = cursor_.error_count();
    const auto statement = parse_statement();
    if (!is_name || outside_reported_ || !statement) return;
    if (cursor_.error_count() != errors_before) return;
    outside_reported_ = true;
    const std::array<std::string, 1> beginning = {"system_name"};
    const bool is_near = !nearest_name(statement->name.text, beginning).empty();
    const bool is_number = statement->kind == ast::StatementKind::definition;
    const bool is_of_domain = is_setting_of(SettingBlock::domain, statement->name.text);
    cursor_.error(statement->name.span,
                  fmt::format("{} belongs to no stage",
                              cursor_.describe({TokenKind::name, statement->name.span})),
                  is_near     ? "did you mean 'system_name'?"
                  : is_number ? fmt::format("write 'let {} = …' for a number of the whole script",
                                            shortened(statement->name.text))
                  : is_of_domain
                      ? fmt::format("write {}: … in the domain block, because it is a setting of "
                                    "the domain",
                                    statement->name.text)
                      : "a stage begins with 'system_name: SYSTEM'");
}

}  // namespace cascade
