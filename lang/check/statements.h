// Statements: the sentences of a system or a stage, one for each name that they say something of
// (internal to the checker). `u[i]: e` is one sentence, and with `i: 1..3` three statements, of
// u[1], u[2] and u[3].
#pragma once

#include "lang/check/check_names.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade::checking {

/// A sentence of a system, its own or one of a system that it is derived from.
struct SystemSentence {
    const ast::Script* script = nullptr;  ///< Its words are of this script.
    const ast::Sentence* sentence = nullptr;
    std::uint32_t level = 0;  ///< 0 in the system that is derived from none, then 1, 2, …
};

struct Statement {
    const ast::Script* script = nullptr;
    const ast::Sentence* sentence = nullptr;
    std::string name;                 ///< `ka`, or of a member `u[2]`.
    std::optional<IndexValue> index;  ///< With u[i]: the value of i. Empty for u[2] and ka.
    std::uint32_t level = 0;
    std::string doc;                  ///< Its own, or that of the sentence it has replaced.
    /// The range of its own, or that of the sentence it has replaced; null where it has none.
    const ast::Range* range = nullptr;
    const ast::Script* range_script = nullptr;

    ast::SentenceKind kind() const { return sentence->kind; }
    Span span() const { return sentence->name.span; }
};

/// The statements of a system, in order. Fills in `system.indices`.
///
/// A statement of a higher level replaces that of its name below: `p:` and `d =` a value or a
/// definition, in its place; `a' =` the whole rate; `a >= e` all bounds of the kind. On one level
/// `u[2]: e` replaces what `u[i]: e` says of u[2], and so for definitions and rates.
std::vector<Statement> system_statements(Workspace& work, System& system,
                                         std::span<const SystemSentence> sentences);

/// The statements that one sentence of a stage stands for, with the indices of its system.
std::vector<Statement> stage_statements(Workspace& work, const System& system,
                                        const ast::Script& script, const ast::Sentence& sentence);

}  // namespace cascade::checking
