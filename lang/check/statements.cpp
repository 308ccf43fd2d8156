// From sentences to statements: indices, members, and what replaces what.
#include "lang/check/statements.h"

#include "lang/check/check_expression.h"
#include "lang/check/expand.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <unordered_map>

namespace cascade::checking {

namespace {

constexpr std::int64_t most_members = 1000;
constexpr std::size_t most_indices = 64;
constexpr std::size_t most_statements = 100'000;

using Kind = ast::SentenceKind;

/// One end of an index, or nothing with a message.
std::optional<std::int64_t> check_end(Workspace& work, const SystemSentence& from,
                                      ast::Expression expression) {
    const auto value = check_constant(work, *from.script, expression, "the end of an index");
    if (!value) return std::nullopt;
    if (*value == std::floor(*value) && *value >= 0 && *value <= 1e9) {
        return static_cast<std::int64_t>(*value);
    }
    work.diagnostics.error(from.script->expressions[expression.root].span,
                           "an index runs over whole numbers from 0 on");
    return std::nullopt;
}

std::optional<Index> check_index(Workspace& work, const SystemSentence& from) {
    const ast::Sentence& sentence = *from.sentence;
    const auto low = check_end(work, from, sentence.values[0]);
    const auto high = check_end(work, from, sentence.values[1]);
    if (!low || !high) return std::nullopt;
    Index index{std::string(sentence.name.text), sentence.name.span, *low, *high};
    if (*low > *high) {
        work.diagnostics.error(sentence.span,
                               fmt::format("the index '{}' has no values", index.name),
                               "the lower end comes first");
        return std::nullopt;
    }
    if (*high - *low >= most_members) {
        work.diagnostics.error(sentence.span,
                               fmt::format("the index '{}' has more than {} values", index.name,
                                           most_members));
        return std::nullopt;
    }
    return index;
}

bool can_be_index(Workspace& work, const ast::Word& name) {
    if (reserved(name.text) == Reserved::no && name.text != "domain") return true;
    work.diagnostics.error(name.span,
                           fmt::format("'{}' belongs to the language and cannot be an index",
                                       name.text));
    return false;
}

std::uint32_t number_of(const Workspace& work, const System& system) {
    return static_cast<std::uint32_t>(&system - work.program.systems.data());
}

/// The indices, of the highest level each.
void collect_indices(Workspace& work, System& system, std::span<const SystemSentence> sentences) {
    std::unordered_map<std::string_view, const SystemSentence*> latest;
    for (const SystemSentence& each : sentences) {
        if (each.sentence->kind != Kind::index || each.sentence->values.size() != 2) continue;
        const auto [first, is_new] = latest.try_emplace(each.sentence->name.text, &each);
        if (is_new) continue;
        if (first->second->level == each.level) {
            report_twice(work, each.sentence->name.span, first->second->sentence->name.span,
                         fmt::format("'{}' is given a value twice", first->first));
        }
        first->second = &each;
    }
    for (const SystemSentence& each : sentences) {
        const auto found = latest.find(each.sentence->name.text);
        if (found == latest.end() || found->second != &each) continue;
        auto index = can_be_index(work, each.sentence->name) ? check_index(work, each) : std::nullopt;
        if (!index) {
            work.incomplete[number_of(work, system)] = true;
            work.faulty_indices.push_back(each.sentence->name.text);
            continue;
        }
        if (system.indices.size() == most_indices) {
            work.diagnostics.error(each.sentence->name.span,
                                   fmt::format("a system has at most {} indices", most_indices));
            return;
        }
        system.indices.push_back(std::move(*index));
    }
}

bool is_number(std::string_view word) { return word[0] >= '0' && word[0] <= '9'; }

/// The 2 of u[2], or nothing with a message.
std::optional<std::int64_t> member_number(Workspace& work, const ast::Word& word) {
    std::int64_t value = 0;
    const auto end = word.text.data() + word.text.size();
    const auto result = std::from_chars(word.text.data(), end, value);
    if (result.ec == std::errc() && result.ptr == end && value <= 1'000'000'000) return value;
    work.diagnostics.error(word.span, "the number of a member is whole");
    return std::nullopt;
}

void report_unknown_index(Workspace& work, const System& system, const ast::Word& word) {
    if (std::find(work.faulty_indices.begin(), work.faulty_indices.end(), word.text) !=
        work.faulty_indices.end()) {
        return;
    }
    std::vector<std::string> names;
    for (const Index& index : system.indices) names.push_back(index.name);
    std::string hint;
    if (!is_hopeless(work)) hint = did_you_mean(work, word.text, names);
    if (hint.empty() && names.empty()) {
        hint = fmt::format("an index is declared in the system: {}: 1..3", word.text);
    } else if (hint.empty()) {
        hint = "it has " + list_names(names);
    }
    work.diagnostics.error(word.span,
                           fmt::format("'{}' is not an index of {}", word.text, system.name),
                           std::move(hint));
}

/// What one sentence stands for.
std::vector<Statement> expand_sentence(Workspace& work, const System& system,
                                       const ast::Script& script, const ast::Sentence& sentence,
                                       std::uint32_t level) {
    Statement statement;
    statement.script = &script;
    statement.sentence = &sentence;
    statement.level = level;
    statement.doc = sentence.doc;
    if (sentence.range) statement.range = &*sentence.range;
    statement.range_script = &script;
    const ast::Word& word = sentence.index;
    if (word.empty()) {
        statement.name = std::string(sentence.name.text);
        return {std::move(statement)};
    }
    if (is_number(word.text)) {
        const auto number = member_number(work, word);
        if (!number) return {};
        statement.name = member_name(sentence.name.text, *number);
        return {std::move(statement)};
    }
    const auto index = std::find_if(system.indices.begin(), system.indices.end(),
                                    [&](const Index& each) { return each.name == word.text; });
    if (index == system.indices.end()) {
        report_unknown_index(work, system, word);
        return {};
    }
    std::vector<Statement> statements;
    for (std::int64_t value = index->low; value <= index->high; ++value) {
        statement.name = member_name(sentence.name.text, value);
        statement.index = IndexValue{word.text, value};
        statements.push_back(statement);
    }
    return statements;
}

/// Puts statements in order and drops those that are replaced.
class StatementList {
public:
    void add(Statement statement) {
        switch (statement.kind()) {
            case Kind::value:
            case Kind::definition: return add_declaration(std::move(statement));
            case Kind::rate: return add_rate(std::move(statement));
            case Kind::rate_term: rates_[statement.name].push_back(all_.size()); break;
            case Kind::at_least:
            case Kind::at_most: return add_bound(std::move(statement));
            case Kind::index: return;
        }
        keep(std::move(statement));
    }
    std::size_t size() const { return all_.size(); }

    std::vector<Statement> take() {
        std::vector<Statement> kept;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (!dropped_[i]) kept.push_back(std::move(all_[i]));
        }
        return kept;
    }

private:
    void keep(Statement statement) {
        all_.push_back(std::move(statement));
        dropped_.push_back(false);
    }
    /// Of one level: does `later` say something of one member that `earlier` says of all?
    static bool is_finer(const Statement& later, const Statement& earlier) {
        return !later.index && earlier.index;
    }

    void add_declaration(Statement statement) {
        const auto [first, is_new] = declarations_.try_emplace(statement.name, all_.size());
        if (is_new) return keep(std::move(statement));
        Statement& before = all_[first->second];
        const bool is_same_level = before.level == statement.level;
        if (is_same_level && is_finer(before, statement)) return;
        if (is_same_level && !is_finer(statement, before)) return keep(std::move(statement));
        if (statement.doc.empty()) statement.doc = std::move(before.doc);
        if (statement.range == nullptr) {
            statement.range = before.range;
            statement.range_script = before.range_script;
        }
        before = std::move(statement);
    }

    void add_rate(Statement statement) {
        std::vector<std::size_t>& before = rates_[statement.name];
        for (const std::size_t i : before) {
            const Statement& other = all_[i];
            if (other.level < statement.level) {
                dropped_[i] = true;
            } else if (other.kind() == Kind::rate && is_finer(statement, other)) {
                dropped_[i] = true;
            } else if (other.kind() == Kind::rate && is_finer(other, statement)) {
                return;
            }
        }
        std::erase_if(before, [&](std::size_t i) { return dropped_[i]; });
        before.push_back(all_.size());
        keep(std::move(statement));
    }

    void add_bound(Statement statement) {
        auto& before = statement.kind() == Kind::at_least ? lower_[statement.name]
                                                          : upper_[statement.name];
        std::erase_if(before, [&](std::size_t i) {
            if (all_[i].level == statement.level) return false;
            dropped_[i] = true;
            return true;
        });
        before.push_back(all_.size());
        keep(std::move(statement));
    }

    std::vector<Statement> all_;
    std::vector<bool> dropped_;
    std::unordered_map<std::string, std::size_t> declarations_;
    std::unordered_map<std::string, std::vector<std::size_t>> rates_, lower_, upper_;
};

}  // namespace

std::vector<Statement> system_statements(Workspace& work, System& system,
                                         std::span<const SystemSentence> sentences) {
    collect_indices(work, system, sentences);
    StatementList list;
    for (const SystemSentence& each : sentences) {
        const ast::Sentence& sentence = *each.sentence;
        if (sentence.kind == Kind::index || sentence.name.empty() || sentence.values.empty()) {
            continue;
        }
        for (Statement& statement :
             expand_sentence(work, system, *each.script, sentence, each.level)) {
            list.add(std::move(statement));
        }
        if (list.size() > most_statements && !sentence.index.empty()) {
            work.diagnostics.error(sentence.name.span,
                                   fmt::format("the families of {} are too large together",
                                               system.name),
                                   fmt::format("a system has at most {} sentences",
                                               most_statements));
            break;
        }
    }
    return list.take();
}

std::vector<Statement> stage_statements(Workspace& work, const System& system,
                                        const ast::Script& script,
                                        const ast::Sentence& sentence) {
    return expand_sentence(work, system, script, sentence, 0);
}

}  // namespace cascade::checking
