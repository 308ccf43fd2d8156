// The syntax tree: a script as it is written, before names and types are checked.
//
// All expressions are stored in one flat list, in which operands come before their operator. A loop
// over a part of the list visits an expression bottom up. So no code needs recursion, however deep
// or long an expression is.
#pragma once

#include "core/source.h"
#include "lang/vocabulary/functions.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cascade::ast {

/// An index into Script::expressions.
using ExprId = std::uint32_t;

/// A word of the script and its source location. `text` is a view of the Sources.
struct Word {
    Span span;
    std::string_view text;
    bool empty() const { return text.empty(); }
};

// clang-format off
struct Number { double value; };
struct Text { std::string value; };                    ///< "leopard.npy"
struct Name { std::string_view name; };                ///< p
struct Bracketed { Word name; };                       ///< [p]
struct Qualified { Word stage, name; };                ///< large.p
struct RateOf { Word name; };                          ///< p'
struct Unary { Function op; ExprId operand; };
struct Binary { Function op; ExprId left, right; };
/// A call. Its arguments are the elements of Script::arguments from `first_argument` on.
struct Call { Word function; std::uint32_t first_argument, argument_count; };
/// sum(operand over index). `index` is the word `domain`, `touching` or `near`, or an index of the
/// system. For near(d), `distance` is d, whose nodes come after the nodes of the operand.
struct Over { Word function; ExprId operand; Word index; std::optional<ExprId> distance; };
/// u[index], A[index, second], [u[index]], large.u[index] or u[index]'. `base` is the Name,
/// Bracketed, Qualified or RateOf of the family. The node of `base` comes directly before the nodes
/// of the indices.
struct Indexed { ExprId base, index; std::optional<ExprId> second = {}; };
/// J.x, the component of a vector. `axis` is the node before this node: a Number 0, 1 or 2. If J is
/// a stage that has a value called x, the expression is a Qualified and not a Component.
struct Component { ExprId operand, axis; Word name; };
// clang-format on
/// Takes the place of text that could not be parsed. An error has been reported, and later passes
/// report no further errors about the text.
struct Garbage {};

struct Expr {
    Span span;
    std::variant<Number, Text, Name, Bracketed, Qualified, RateOf, Unary, Binary, Call, Over,
                 Indexed, Component, Garbage>
        node;
};

/// One expression: the nodes [first, root] of Script::expressions. The last node, `root`, is the
/// outermost operator.
struct Expression {
    ExprId first = 0;
    ExprId root = 0;
};

enum class StatementKind : std::uint8_t {
    value,       ///< name: e      (or  name: e, e  in a domain)
    definition,  ///< name = e
    rate,        ///< name' = e
    rate_term,   ///< name' += e
    at_least,    ///< name >= e
    at_most,     ///< name <= e
    index,       ///< name: low .. high. The values of the statement are the two ends.
    constraint,  ///< 0 = e. The name of the statement is the 0.
};

/// The range of a parameter, which follows its value: in low .. high [step e].
struct Range {
    Expression low, high;
    std::optional<Expression> step;
    Span span;
};

struct Statement {
    StatementKind kind = StatementKind::value;
    Word name;
    /// The index: i in `u[i]: e`, which may be a name or a number, or i,j in `A[i, j]: e`
    /// (lang/syntax/index_words.h). Empty if the statement has no index.
    Word index;
    Word side;  ///< The side: left in `u.left: e`. Otherwise empty.
    /// The species whose second rate the statement gives: u in `u'' = e`, which becomes u_t' = e
    /// (lang/syntax/second_rates.h). Otherwise empty.
    Word second;
    Word after;                      ///< The event: divide in `u: e after divide`. Otherwise empty.
    std::vector<Expression> values;  ///< The values, at least one.
    std::optional<Range> range;      ///< Only for the kind `value`.
    Span span;                       ///< From the name to the end of the last value.
    std::string doc;  ///< The text of the statement's doc comments, joined to one line.
};

enum class BlockKind : std::uint8_t {
    system,         ///< system NAME { … } or cells NAME { … }
    stage,          ///< stage NAME: SYSTEM { … }
    classic_stage,  ///< system_name: SYSTEM and the statements after it
    domain,         ///< domain { … }
    picture,        ///< picture { … }
    shape,          ///< shape NAME { … }
};

struct Block {
    BlockKind kind = BlockKind::system;
    bool is_cells = false;  ///< Whether the block is a system of crawling cells.
    Word keyword;  ///< `system`, `stage`, `system_name`, …. Messages about the block point here.
    Span span;     ///< From the keyword to the `}`. Empty for a classic stage.
    Word name;     ///< The name of a system, a stage or a shape. Otherwise empty.
    /// For a stage, its system; empty if the system could not be parsed. For a system or a shape,
    /// its base; empty if there is none.
    Word base;
    std::vector<Word> joined;  ///< For cells, the bases after the first base.
    std::vector<Statement> statements;
    std::vector<Statement> sides;  ///< The statements about sides: `u.left: …`, `u[1].left: …`.
    std::string doc;               ///< The text of the block's doc comments, joined to one line.
    /// Whether a part of the block could not be parsed and is missing here. An error has been
    /// reported.
    bool is_damaged = false;
};

/// The definition `fn name(parameters) = body`, or `let name = body`, whose name is used without
/// brackets.
struct FunctionDefinition {
    Word name;
    std::vector<Word> parameters;
    Expression body;
    /// From the keyword to the end of the body. Empty if the definition could not be parsed.
    Span span;
    bool is_constant = false;  ///< Whether the definition is written with `let`.
    std::string doc;
};

/// use "file.cascade"
struct Use {
    Span span;         ///< Where the string is in the script.
    std::string path;  ///< The path as the script gives it.
};

/// A value from outside the script (`--set large.ka=1/400`). The value replaces the statement of
/// the same name in the stage called `stage`. If there is no such stage, the value replaces the
/// statement in all stages whose system is called `stage`. If `stage` is empty, the value replaces
/// the statement in all stages that have a statement of this name.
struct Override {
    Word stage;
    Statement statement;
};

struct Script {
    std::vector<Block> blocks;
    std::vector<FunctionDefinition> functions;
    std::vector<Use> uses;
    std::vector<Override> overrides;
    /// Settings that options give for the domain and for all stages: --grid 64x32 is `grid: 64,
    /// 32`. The options override the script. The source of each statement is the text of its
    /// option. The statement for --fast has no value.
    std::vector<Statement> options;
    std::vector<Expr> expressions;
    std::vector<ExprId> arguments;
};

/// The source location of an expression.
inline Span span_of(const Script& script, Expression expression) {
    return script.expressions[expression.root].span;
}

}  // namespace cascade::ast
