// Statements are compared by what they are about and, where two bases disagree, by their text.
#include "lang/check/join_statements.h"

#include "lang/check/system_statements.h"
#include "lang/syntax/index_words.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace cascade::checking {

namespace {

/// Does `later` replace `earlier`, if it is of a higher level and about the same subject?
bool replaces(const ast::Statement& later, const ast::Statement& earlier) {
    if (later.kind == ast::StatementKind::rate_term || later.kind == ast::StatementKind::constraint)
        return false;
    return !is_of_some_members(later.index) || later.index.text == earlier.index.text;
}

/// The text of a statement, without its doc comment.
std::string_view text_of(const ast::Statement& statement) {
    return {statement.name.text.data(), statement.span.end - statement.name.span.begin};
}

/// The statements that no later one replaces, as statements of level 0.
std::vector<SystemStatement> effective(const std::vector<SystemStatement>& statements) {
    std::unordered_map<std::string, std::vector<const SystemStatement*>> later;
    std::vector<SystemStatement> kept;
    for (auto each = statements.rbegin(); each != statements.rend(); ++each) {
        auto& others = later[subject_of(*each->statement)];
        const bool is_replaced = std::ranges::any_of(others, [&](const SystemStatement* other) {
            return other->level > each->level && replaces(*other->statement, *each->statement);
        });
        others.push_back(&*each);
        if (!is_replaced) kept.push_back({each->script, each->statement, 0});
    }
    std::ranges::reverse(kept);
    return kept;
}

}  // namespace

void join_statements(Workspace& work, std::vector<SystemStatement>& statements,
                     const std::vector<SystemStatement>& more, const ast::Block& block) {
    statements = effective(statements);
    std::unordered_set<std::string> said;  // By the block itself.
    for (const ast::Statement& own : block.statements) {
        if (own.kind != ast::StatementKind::rate_term)
            said.insert(subject_of(own) + " " + std::string(own.index.text));
    }
    std::unordered_set<const ast::Statement*> known;
    std::unordered_map<std::string, const ast::Statement*> by_subject;
    for (const SystemStatement& each : statements) {
        known.insert(each.statement);
        if (each.statement->kind == ast::StatementKind::rate_term) continue;
        by_subject.try_emplace(subject_of(*each.statement) + " " +
                                   std::string(each.statement->index.text),
                               each.statement);
    }
    for (const SystemStatement& each : effective(more)) {
        const ast::Statement& statement = *each.statement;
        if (known.contains(&statement)) continue;
        if (statement.kind == ast::StatementKind::rate_term) {
            statements.push_back(each);
            continue;
        }
        const std::string subject = subject_of(statement) + " " + std::string(statement.index.text);
        const auto other = by_subject.find(subject);
        // Of texts for readers, such as the title, the first base's count.
        const bool is_for_readers = is_setting_of(SettingBlock::system, statement.name.text);
        if (other == by_subject.end()) {
            statements.push_back(each);
        } else if (is_for_readers) {
            continue;
        } else if (text_of(*other->second) != text_of(statement) && !said.contains(subject)) {
            Diagnostic diagnostic;
            diagnostic.span = block.joined.empty() ? block.base.span : block.joined.front().span;
            diagnostic.message = fmt::format("the bases of '{}' differ in '{}'", block.name.text,
                                             statement.name.text);
            diagnostic.hint =
                fmt::format("say in {} what holds: {}", block.name.text, text_of(statement));
            diagnostic.notes.push_back({other->second->name.span, "one is here"});
            diagnostic.notes.push_back({statement.name.span, "the other is here"});
            work.diagnostics.add(std::move(diagnostic));
        }
    }
}

}  // namespace cascade::checking
