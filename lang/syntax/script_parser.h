// Parses blocks and statements.
#pragma once

#include "lang/syntax/ast.h"
#include "lang/syntax/expression_parser.h"
#include "lang/syntax/token_cursor.h"

#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The parser of one source, which becomes a part of a script.
class ScriptParser {
public:
    ScriptParser(TokenCursor& cursor, ast::Script& script)
        : cursor_(cursor), script_(script), expressions_(cursor, script) {}

    /// Parses everything up to the end of the text.
    void parse_script();
    /// Parses `[stage.]name=expression`, which must be the whole text.
    void parse_override();
    bool parse_word_after_dot(ast::Word& word, const std::string& form);
    /// Parses an expression, which must be the whole text.
    std::optional<ast::Expression> parse_lone_expression();

private:
    // Blocks (parser_blocks.cpp).
    void parse_item();
    void parse_block(std::string_view keyword);
    bool parse_misspelt_block();
    void parse_header_of_system(ast::Block& block);
    void parse_bases(ast::Block& block);
    void parse_header_of_stage(ast::Block& block);
    void parse_header_without_name();
    void parse_body(ast::Block& block);
    std::string hint_of_missing_bracket(const Token& header_end) const;
    void report_unclosed(const Token& open, const ast::Block& block);
    void parse_classic_stage();
    void parse_base_of_classic_stage(ast::Block& block);
    void parse_outside_statement();
    bool begins_classic_stage() const { return cursor_.at_name("system_name"); }

    // `fn`, `let` and `use` (parser_functions.cpp).
    bool begins_function() const {
        return (cursor_.at_name("fn") || cursor_.at_name("let")) &&
               cursor_.kind(1) == TokenKind::name;
    }
    bool begins_use() const;
    bool parse_function_or_use();
    bool refuse_function_or_use();
    void parse_function();
    bool parse_parameters(ast::FunctionDefinition& function);
    void keep_damaged(ast::FunctionDefinition function);
    void parse_use();

    // Statements (parser_statements.cpp).
    std::optional<ast::Statement> parse_statement();
    void parse_side(ast::Statement& statement);
    void add_statement(ast::Block& block, ast::Statement statement);
    bool parse_relation(ast::Statement& statement);
    bool parse_rate_relation(ast::Statement& statement);
    void parse_values(ast::Statement& statement);
    bool parse_index(ast::Statement& statement);
    void parse_end_of_index(ast::Statement& statement);
    void parse_more_ranges(ast::Statement& statement);
    void parse_range(ast::Statement& statement);
    void parse_after(ast::Statement& statement);
    ast::Expression parse_after_operator(const std::string& owner,
                                         std::span<const std::string_view> ends);

    // Faults of statements (statement_faults.cpp).
    std::string hint_of_index(std::string_view name) const;
    void report_dot(const ast::Statement& statement);
    bool line_has_garbage() const;
    std::string hint_of_missing_colon(const ast::Word& name) const;
    bool report_missing_colon(const ast::Statement& statement);
    bool has_shape_of_block(std::size_t ahead) const;
    std::string report_no_block(const ast::Word& word);
    bool report_third_rate(const ast::Statement& statement);
    bool take_paper_rate(ast::Statement& statement);
    bool report_no_statement();
    void skip_type(const ast::Word& name);

    /// The text of the doc comments before the cursor. They belong to the item that begins at the
    /// cursor.
    std::string docs_before();
    /// The text of the doc comments of the item that began at `begin` and was just parsed. Includes
    /// comments after the item on the item's last line.
    std::string docs_after(std::uint32_t begin);
    static void add_docs(std::string& doc, const std::string& more);

    void report_rest(const std::string& what, ast::Expression expression, const std::string& hint);

    TokenCursor& cursor_;
    ast::Script& script_;
    ExpressionParser expressions_;
    /// Whether the statements that follow belong to the script's last block, which is a classic
    /// stage.
    bool in_classic_stage_ = false;
    bool outside_reported_ = false;  ///< Whether any statement outside of stages has been reported.
    /// How many `}` to accept without an error, because their blocks have been reported as
    /// unclosed.
    std::size_t forgiven_closings_ = 0;
};

}  // namespace cascade
