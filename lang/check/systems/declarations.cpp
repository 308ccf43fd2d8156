// Turns statements into declarations: expands indices, and drops statements that are overridden.
#include "lang/check/systems/declarations.h"

#include "core/counted.h"
#include "lang/check/systems/check_systems.h"
#include "lang/check/expressions/check_expression.h"
#include "lang/check/expressions/expand.h"
#include "lang/syntax/index_words.h"
#include "lang/vocabulary/settings.h"
#include "lang/check/expressions/read_setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>

namespace cascade::checking {

namespace {

constexpr std::int64_t most_members = 1000;
constexpr std::size_t most_indices = 64;
constexpr std::size_t most_declarations = 100'000;

/// The number at one end of the range of an index. Reports errors.
std::optional<std::int64_t> check_end(Workspace& work, const SystemStatement& from,
                                      ast::Expression expression) {
    const auto value = check_constant(work, *from.script, expression, "the end of an index");
    if (!value) return std::nullopt;
    if (*value == std::floor(*value) && *value >= 0 && *value <= 1e9) {
        return static_cast<std::int64_t>(*value);
    }
    work.diagnostics.error(from.script->expressions[expression.root].span,
                           "the ends of an index must be whole numbers of at least 0");
    return std::nullopt;
}

std::optional<Index> check_index(Workspace& work, const SystemStatement& from) {
    const ast::Statement& statement = *from.statement;
    const auto low = check_end(work, from, statement.values[0]);
    const auto high = check_end(work, from, statement.values[1]);
    if (!low || !high) return std::nullopt;
    Index index{std::string(statement.name.text), statement.name.span, *low, *high};
    if (*low > *high) {
        work.diagnostics.error(statement.span,
                               fmt::format("the index '{}' has no values", index.name),
                               "write the lower end first");
        return std::nullopt;
    }
    if (*high - *low >= most_members) {
        work.diagnostics.error(statement.span, fmt::format("the index '{}' has more than {} values",
                                                           index.name, most_members));
        return std::nullopt;
    }
    return index;
}

bool can_be_index(Workspace& work, const ast::Word& name) {
    if (reserved(name.text) == Reserved::no && name.text != "domain") return true;
    work.diagnostics.error(
        name.span,
        fmt::format("'{}' cannot be an index, because it is a word of the language", name.text));
    return false;
}

SystemId id_of(const Workspace& work, const System& system) {
    return SystemId(static_cast<std::size_t>(&system - work.program.systems.data()));
}

/// Collects the indices. If several indices have the same name, takes the index from the system
/// that is derived last.
void collect_indices(Workspace& work, System& system, std::span<const SystemStatement> statements) {
    std::unordered_map<std::string_view, const SystemStatement*> latest;
    for (const SystemStatement& each : statements) {
        if (each.statement->kind != ast::StatementKind::index || each.statement->values.size() != 2)
            continue;
        const auto [first, is_new] = latest.try_emplace(each.statement->name.text, &each);
        if (is_new) continue;
        if (first->second->level == each.level) {
            report_twice(work, each.statement->name.span, first->second->statement->name.span,
                         fmt::format("'{}' is given a value twice", first->first));
        }
        first->second = &each;
    }
    for (const SystemStatement& each : statements) {
        const auto found = latest.find(each.statement->name.text);
        if (found == latest.end() || found->second != &each) continue;
        auto index =
            can_be_index(work, each.statement->name) ? check_index(work, each) : std::nullopt;
        if (!index) {
            work.incomplete[id_of(work, system)] = true;
            work.invalid_indices.push_back(each.statement->name.text);
            continue;
        }
        if (system.indices.size() == most_indices) {
            work.diagnostics.error(each.statement->name.span,
                                   fmt::format("a system has at most {} indices", most_indices));
            return;
        }
        system.indices.push_back(std::move(*index));
    }
}

/// The number of a member: 2 in u[2]. Reports an error if the word is not a number.
std::optional<std::int64_t> member_number(Workspace& work, const ast::Word& word) {
    std::int64_t value = 0;
    const auto end = word.text.data() + word.text.size();
    const auto result = std::from_chars(word.text.data(), end, value);
    if (result.ec == std::errc() && result.ptr == end && value <= 1'000'000'000) return value;
    work.diagnostics.error(word.span, "the number of a member must be a whole number");
    return std::nullopt;
}

void report_unknown_index(Workspace& work, const System& system, const ast::Word& word) {
    if (std::find(work.invalid_indices.begin(), work.invalid_indices.end(), word.text) !=
        work.invalid_indices.end()) {
        return;
    }
    std::vector<std::string> names;
    for (const Index& index : system.indices) names.push_back(index.name);
    std::string hint;
    if (!is_hopeless(work)) hint = did_you_mean(work, word.text, names);
    if (hint.empty() && names.empty()) {
        hint = fmt::format("declare it in the system, as in {}: 1..3", word.text);
    } else if (hint.empty()) {
        hint = "it has " + list_names(names);
    }
    work.diagnostics.error(word.span,
                           fmt::format("'{}' is not an index of {}", word.text, system.name),
                           std::move(hint));
}

/// The indices of a statement. A number counts as an index that has no name and a single value.
/// Empty if there is an error.
std::vector<Index> indices_of(Workspace& work, const System& system, const ast::Word& of) {
    std::vector<Index> indices;
    for (const ast::Word& word : words_of_index(of)) {
        if (is_number(word)) {
            const auto number = member_number(work, word);
            if (!number) return {};
            indices.push_back({{}, word.span, *number, *number});
            continue;
        }
        const auto index = std::ranges::find(system.indices, word.text, &Index::name);
        if (index == system.indices.end()) {
            report_unknown_index(work, system, word);
            return {};
        }
        if (!indices.empty() && indices.front().name == word.text) {
            work.diagnostics.error(word.span,
                                   "the two indices of a family must have different "
                                   "names",
                                   fmt::format("declare another one for the second: {}2: {}..{}",
                                               word.text, index->low, index->high));
            return {};
        }
        indices.push_back(*index);
    }
    return indices;
}

/// Reports a list that does not contain exactly one value for each member.
void check_list(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                std::int64_t members) {
    const auto values = static_cast<std::int64_t>(statement.values.size());
    if (values == members) return;
    const ast::Expression last = values > members
                                     ? statement.values[static_cast<std::size_t>(members)]
                                     : statement.values.back();
    work.diagnostics.error(script.expressions[last.root].span,
                           fmt::format("{}[{}] has {}, and the list {}", statement.name.text,
                                       statement.index.text, counted(members, "member"),
                                       counted(values, "value")),
                           "a family takes one value for all members, or one for each");
}

void report_too_many(Workspace& work, const System& system, const ast::Statement& statement) {
    work.diagnostics.error(statement.name.span,
                           fmt::format("the families of {} are too large in total", system.name),
                           fmt::format("a system has at most {} statements", most_declarations));
}

std::vector<Declaration> expand_statement(Workspace& work, const System& system,
                                          const ast::Script& script,
                                          const ast::Statement& statement, std::uint32_t level) {
    Declaration declaration;
    declaration.script = &script;
    declaration.statement = &statement;
    declaration.level = level;
    declaration.doc = statement.doc;
    if (statement.range) declaration.range = &*statement.range;
    declaration.range_script = &script;
    if (statement.index.empty()) {
        declaration.name = std::string(statement.name.text);
        return {std::move(declaration)};
    }
    const std::vector<ast::Word> words = words_of_index(statement.index);
    const auto indices = indices_of(work, system, statement.index);
    if (indices.empty()) return {};
    std::int64_t members = 1;
    for (const Index& index : indices) members *= index.high - index.low + 1;
    if (members > static_cast<std::int64_t>(most_declarations)) {
        report_too_many(work, system, statement);
        return {};
    }
    const std::size_t count = statement.values.size();
    const bool is_one_member = std::ranges::all_of(words, is_number);
    const bool is_list = statement.kind == ast::StatementKind::value && count > 1 && !is_one_member;
    if (is_list) check_list(work, script, statement, members);
    std::vector<Declaration> declarations;
    std::vector<std::int64_t> values;
    for (const Index& index : indices) values.push_back(index.low);
    for (std::int64_t member = 0; member < members; ++member) {
        declaration.name = member_name(statement.name.text, values);
        declaration.indices.clear();
        for (std::size_t k = 0; k < words.size(); ++k) {
            if (!is_number(words[k])) declaration.indices.push_back({words[k].text, values[k]});
        }
        if (is_list) declaration.listed = std::min(declarations.size(), count - 1);
        declarations.push_back(declaration);
        // The last index changes fastest.
        for (std::size_t k = values.size(); k-- > 0 && ++values[k] > indices[k].high;) {
            values[k] = indices[k].low;
        }
    }
    return declarations;
}

/// A list of declarations, in order. Does not contain declarations that other declarations replace.
class StatementList {
public:
    void add(Declaration declaration) {
        switch (declaration.kind()) {
            case ast::StatementKind::value:
            case ast::StatementKind::definition: return add_declaration(std::move(declaration));
            case ast::StatementKind::rate: return add_rate(std::move(declaration));
            case ast::StatementKind::rate_term:
                rates_[declaration.name].push_back(all_.size());
                break;
            case ast::StatementKind::constraint: break;
            case ast::StatementKind::at_least:
            case ast::StatementKind::at_most: return add_bound(std::move(declaration));
            case ast::StatementKind::index: return;
        }
        keep(std::move(declaration));
    }
    std::size_t size() const { return all_.size(); }

    std::vector<Declaration> take() {
        std::vector<Declaration> kept;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (!dropped_[i]) kept.push_back(std::move(all_[i]));
        }
        return kept;
    }

private:
    void keep(Declaration declaration) {
        all_.push_back(std::move(declaration));
        dropped_.push_back(false);
    }
    /// Whether `later` is about fewer members of a family than `earlier`. Both declarations belong
    /// to the same system.
    static bool is_finer(const Declaration& later, const Declaration& earlier) {
        return later.indices.size() < earlier.indices.size();
    }

    void add_declaration(Declaration declaration) {
        const std::string key = declaration.name + (declaration.is_restart() ? " after" : "");
        const auto [first, is_new] = declarations_.try_emplace(key, all_.size());
        if (is_new) return keep(std::move(declaration));
        Declaration& before = all_[first->second];
        const bool is_same_level = before.level == declaration.level;
        if (is_same_level && is_finer(before, declaration)) return;
        if (is_same_level && !is_finer(declaration, before)) return keep(std::move(declaration));
        if (declaration.doc.empty()) declaration.doc = std::move(before.doc);
        if (declaration.range == nullptr) {
            declaration.range = before.range;
            declaration.range_script = before.range_script;
        }
        before = std::move(declaration);
    }

    void add_rate(Declaration declaration) {
        std::vector<std::size_t>& before = rates_[declaration.name];
        for (const std::size_t i : before) {
            const Declaration& other = all_[i];
            if (other.level < declaration.level) {
                dropped_[i] = true;
            } else if (other.kind() == ast::StatementKind::rate && is_finer(declaration, other)) {
                dropped_[i] = true;
            } else if (other.kind() == ast::StatementKind::rate && is_finer(other, declaration)) {
                return;
            }
        }
        std::erase_if(before, [&](std::size_t i) { return dropped_[i]; });
        before.push_back(all_.size());
        keep(std::move(declaration));
    }

    void add_bound(Declaration declaration) {
        auto& before = declaration.kind() == ast::StatementKind::at_least
                           ? lower_[declaration.name]
                           : upper_[declaration.name];
        std::erase_if(before, [&](std::size_t i) {
            if (all_[i].level == declaration.level) return false;
            dropped_[i] = true;
            return true;
        });
        before.push_back(all_.size());
        keep(std::move(declaration));
    }

    std::vector<Declaration> all_;
    std::vector<bool> dropped_;
    std::unordered_map<std::string, std::size_t> declarations_;
    std::unordered_map<std::string, std::vector<std::size_t>> rates_, lower_, upper_;
};

}  // namespace

std::vector<Declaration> system_declarations(Workspace& work, System& system,
                                             std::span<const SystemStatement> statements) {
    collect_indices(work, system, statements);
    StatementList list;
    for (const SystemStatement& each : statements) {
        const ast::Statement& statement = *each.statement;
        if (statement.kind == ast::StatementKind::index || statement.name.empty() ||
            statement.values.empty()) {
            continue;
        }
        for (Declaration& declaration :
             expand_statement(work, system, *each.script, statement, each.level)) {
            list.add(std::move(declaration));
        }
        if (list.size() > most_declarations && !statement.index.empty()) {
            report_too_many(work, system, statement);
            break;
        }
    }
    return list.take();
}

bool has_one_value(Workspace& work, const Declaration& declaration) {
    return declaration.listed || has_one_value(work, *declaration.script, *declaration.statement);
}

std::vector<Declaration> stage_declarations(Workspace& work, const System& system,
                                            const ast::Script& script,
                                            const ast::Statement& statement) {
    return expand_statement(work, system, script, statement, 0);
}

}  // namespace cascade::checking
