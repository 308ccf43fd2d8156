// The syntax tree: what a script says, before anyone has asked whether it makes sense.
//
// Expressions live in one flat list, operands before their operator, so that nothing here is ever
// walked or destroyed by recursion: a loop over a stretch of the list visits an expression bottom
// up, however deep or long it is.
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

/// Position in Script::expressions.
using ExprId = std::uint32_t;

/// A word of the script, with its place. The view points into the Sources.
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
/// Arguments are Script::arguments[first_argument …], in order.
struct Call { Word function; std::uint32_t first_argument, argument_count; };
/// sum(operand over index); `index` is the word `domain` or an index of the system.
struct Over { Word function; ExprId operand; Word index; };
/// u[index], [u[index]], large.u[index], u[index]': `base` is the Name, Bracketed, Qualified or
/// RateOf of the family, which stands directly before the parts of the index.
struct Indexed { ExprId base, index; };
// clang-format on
/// What could not be read. A message has been given already; later stages stay silent about it.
struct Garbage {};

struct Expr {
    Span span;
    std::variant<Number, Text, Name, Bracketed, Qualified, RateOf, Unary, Binary, Call, Over,
                 Indexed, Garbage>
        node;
};

/// The stretch [first, root] of Script::expressions: all parts of one expression, `root` last.
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
    index,       ///< name: low .. high; the values are the two ends
};

/// in low .. high [step e], after the value of a parameter.
struct Range {
    Expression low, high;
    std::optional<Expression> step;
    Span span;
};

struct Statement {
    StatementKind kind = StatementKind::value;
    Word name;
    Word index;                      ///< i of `u[i]: e`: a name or a number; empty without one.
    Word side;                       ///< left of `u.left: e`; empty without one.
    std::vector<Expression> values;  ///< At least one.
    std::optional<Range> range;      ///< Of a value only.
    Span span;                       ///< From the name to the end of the last value.
    std::string doc;                 ///< The text of its doc comments, joined to one line.
};

enum class BlockKind : std::uint8_t {
    system,         ///< system NAME { … }
    stage,          ///< stage NAME: SYSTEM { … }
    classic_stage,  ///< system_name: SYSTEM and the statements after it
    domain,         ///< domain { … }
    picture,        ///< picture { … }
};

struct Block {
    BlockKind kind = BlockKind::system;
    Word keyword;  ///< `system`, `stage`, `system_name`, …: the block's place in messages.
    Word name;     ///< Of a system or stage; empty for others.
    /// The stage's system; empty where it could not be read. Of a system: the system it is derived
    /// from, empty where it is derived from none.
    Word base;
    std::vector<Statement> statements;
    std::vector<Statement> sides;  ///< `u.left: …`, `u[1].left: …`.
    std::string doc;               ///< The text of its doc comments, joined to one line.
    /// Something of it could not be read and is not in these lists; it has its message.
    bool is_damaged = false;
};

/// fn name(parameters) = body
struct FunctionDefinition {
    Word name;
    std::vector<Word> parameters;
    Expression body;
    std::string doc;
};

/// use "file.cascade"
struct Use {
    Span span;         ///< Of the text in quotes.
    std::string path;  ///< As written.
};

/// A value from outside the script (`--set large.ka=1/400`): it replaces the statement of that name
/// in one stage, or, where no stage is called so, in every stage of the system of that name, or,
/// where `stage` is empty, in every stage that has such a name.
struct Override {
    Word stage;
    Statement statement;
};

struct Script {
    std::vector<Block> blocks;
    std::vector<FunctionDefinition> functions;
    std::vector<Use> uses;
    std::vector<Override> overrides;
    /// What other options of the command line say of the domain and of all stages: --grid 64x32 is
    /// `grid: 64, 32`. An option has the last word. Each has a source of its own, the typed text;
    /// --fast has no value.
    std::vector<Statement> options;
    std::vector<Expr> expressions;
    std::vector<ExprId> arguments;
};

}  // namespace cascade::ast
