// Splits the statements of a system or a stage into declarations, one for each name (internal to
// the checker). The statement `u[i]: e` with `i: 1..3` becomes three declarations, of u[1], u[2]
// and u[3]. A list such as `u[i]: e1, e2, e3` gives each of these members its own value. In a list
// for A[i, j], the last index changes fastest.
#pragma once

#include "lang/check/names/check_names.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade::checking {

/// A statement of a system or of one of its bases.
struct SystemStatement {
    const ast::Script* script = nullptr;  ///< The script that contains the statement.
    const ast::Statement* statement = nullptr;
    /// 0 in a system without a base, 1 in a system derived from it, and so on.
    std::uint32_t level = 0;
};

struct Declaration {
    const ast::Script* script = nullptr;
    const ast::Statement* statement = nullptr;
    std::string name;  ///< `ka`; `u[2]` for a member; `A[1,2]` for a member with two indices.
    /// The values of the named indices: for `u[i]`, the value of i.
    std::vector<IndexValue> indices;
    /// The position of the declaration's value, if the statement gives a list.
    std::optional<std::size_t> listed;
    std::uint32_t level = 0;
    /// The doc comment of the declaration or, if it has none, of the declaration that it replaces.
    std::string doc;
    /// The range of the declaration or, if it has none, of the declaration that it replaces. Null
    /// if neither has a range.
    const ast::Range* range = nullptr;
    const ast::Script* range_script = nullptr;

    ast::StatementKind kind() const { return statement->kind; }
    ast::Expression value() const { return statement->values[listed.value_or(0)]; }
    /// Whether the declaration has the form `u: e after divide`.
    bool is_restart() const { return !statement->after.empty(); }
    Span span() const { return statement->name.span; }
};

/// The declarations of a system, in order. Fills in `system.indices`.
///
/// A declaration replaces declarations of the same name in bases. `p:` replaces a value and `d =`
/// replaces a definition. Both take the position of what they replace. `p: e after divide` replaces
/// only a declaration with `after divide`. `a' =` replaces the whole rate. `a >= e` replaces all
/// bounds of the same kind. Within a system, the value, definition or rate of a single member, as
/// in `u[2]: e`, replaces what `u[i]: e` gives this member.
std::vector<Declaration> system_declarations(Workspace& work, System& system,
                                             std::span<const SystemStatement> statements);

/// Whether the declaration has one value. If its statement has several values that are not a list,
/// reports an error.
bool has_one_value(Workspace& work, const Declaration& declaration);

/// The declarations that a statement of a stage makes. Indices have the values that the stage's
/// system gives them.
std::vector<Declaration> stage_declarations(Workspace& work, const System& system,
                                            const ast::Script& script,
                                            const ast::Statement& statement);

}  // namespace cascade::checking
