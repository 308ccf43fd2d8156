// Statements: the statements of a system or a stage, one for each name that they say something of
// (internal to the checker). `u[i]: e` is one statement, and with `i: 1..3` three declarations, of
// u[1], u[2] and u[3].
#pragma once

#include "lang/check/check_names.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade::checking {

/// A statement of a system, its own or one of a system that it is derived from.
struct SystemStatement {
    const ast::Script* script = nullptr;  ///< Its words are of this script.
    const ast::Statement* statement = nullptr;
    std::uint32_t level = 0;  ///< 0 in the system that is derived from none, then 1, 2, …
};

struct Declaration {
    const ast::Script* script = nullptr;
    const ast::Statement* statement = nullptr;
    std::string name;                 ///< `ka`, or of a member `u[2]`.
    std::optional<IndexValue> index;  ///< With u[i]: the value of i. Empty for u[2] and ka.
    std::uint32_t level = 0;
    std::string doc;  ///< Its own, or that of the statement it has replaced.
    /// The range of its own, or that of the statement it has replaced; null where it has none.
    const ast::Range* range = nullptr;
    const ast::Script* range_script = nullptr;

    ast::StatementKind kind() const { return statement->kind; }
    Span span() const { return statement->name.span; }
};

/// The declarations of a system, in order. Fills in `system.indices`.
///
/// A declaration of a higher level replaces that of its name below: `p:` and `d =` a value or a
/// definition, in its place; `a' =` the whole rate; `a >= e` all bounds of the kind. On one level
/// `u[2]: e` replaces what `u[i]: e` says of u[2], and so for definitions and rates.
std::vector<Declaration> system_declarations(Workspace& work, System& system,
                                             std::span<const SystemStatement> statements);

/// The declarations that one statement of a stage stands for, with the indices of its system.
std::vector<Declaration> stage_declarations(Workspace& work, const System& system,
                                            const ast::Script& script,
                                            const ast::Statement& statement);

}  // namespace cascade::checking
