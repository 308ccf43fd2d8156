// Declarations: the statements of a system or a stage, one for each name (internal to the checker).
// `u[i]: e` is one statement; with `i: 1..3` it becomes three declarations, of u[1], u[2] and u[3].
// In a list, `u[i]: e, e, e`, each has a value of its own; the last index of A[i, j] changes first.
#pragma once

#include "lang/check/names/check_names.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade::checking {

/// A statement of a system or of one of its bases.
struct SystemStatement {
    const ast::Script* script = nullptr;  ///< The script that it is written in.
    const ast::Statement* statement = nullptr;
    std::uint32_t level = 0;  ///< 0 in the system that has no base, then 1, 2, …
};

struct Declaration {
    const ast::Script* script = nullptr;
    const ast::Statement* statement = nullptr;
    std::string name;  ///< `ka`, `u[2]` for a member, `A[1,2]` for one of two indices.
    std::vector<IndexValue> indices;    ///< The value of i for u[i]; none for u[2] and ka.
    std::optional<std::size_t> listed;  ///< Its place in the list of the statement, if it has one.
    std::uint32_t level = 0;
    std::string doc;  ///< Its own doc comment, or that of the declaration it has replaced.
    /// Its own range, or that of the declaration it has replaced; null if there is none.
    const ast::Range* range = nullptr;
    const ast::Script* range_script = nullptr;

    ast::StatementKind kind() const { return statement->kind; }
    ast::Expression value() const { return statement->values[listed.value_or(0)]; }
    /// Is it `u: e after divide`?
    bool is_restart() const { return !statement->after.empty(); }
    Span span() const { return statement->name.span; }
};

/// The declarations of a system, in order. Fills in `system.indices`.
///
/// A declaration of a higher level replaces that of its name on lower levels: `p:` and `d =` a
/// value or a definition, in its position; `p: e after divide` only one of these; `a' =` the whole
/// rate; `a >= e` all bounds of the same kind. On one level `u[2]: e` replaces what `u[i]: e` says
/// about u[2]; the same holds for definitions and rates.
std::vector<Declaration> system_declarations(Workspace& work, System& system,
                                             std::span<const SystemStatement> statements);

/// Has it one value? Reports an error if its statement has several that are no list.
bool has_one_value(Workspace& work, const Declaration& declaration);

/// The declarations of a statement of a stage, with the indices of its system.
std::vector<Declaration> stage_declarations(Workspace& work, const System& system,
                                            const ast::Script& script,
                                            const ast::Statement& statement);

}  // namespace cascade::checking
