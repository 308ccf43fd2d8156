// Orders systems topologically by their bases, and reports cycles. In each system, puts the
// statements of its bases before its own statements.
#include "lang/check/systems/system_inheritance.h"

#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_cycles.h"
#include "lang/check/expressions/user_functions.h"
#include "lang/check/names/unknown_names.h"
#include "lang/check/systems/declarations.h"
#include "lang/check/names/note_uses.h"
#include "lang/library/system_statements.h"
#include "lang/program/order.h"
#include "lang/syntax/index_words.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace cascade::checking {

namespace {

// Blocks of cells with several bases, `cells a: b, c { … }` (internal to the checker).

/// Whether `later` replaces `earlier`. Both statements have the same subject, and `later` belongs
/// to a system derived from the system of `earlier`.
bool replaces(const ast::Statement& later, const ast::Statement& earlier) {
    if (later.kind == ast::StatementKind::rate_term || later.kind == ast::StatementKind::constraint)
        return false;
    return !is_of_some_members(later.index) || later.index.text == earlier.index.text;
}

/// The text of a statement, without its doc comment.
std::string_view text_of(const ast::Statement& statement) {
    return {statement.name.text.data(), statement.span.end - statement.name.span.begin};
}

/// The statements that no later statement replaces. Their level is set to 0.
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

/// Adds the statements of a further base to the statements of earlier bases. All terms of rates
/// remain, in order. If two bases give different values to the same name, reports an error, unless
/// the derived `block` gives this name a value. A statement that several bases inherit from a
/// common base is added once. Afterwards all statements have level 0, and none replaces another.
void join_statements(Workspace& work, std::vector<SystemStatement>& statements,
                     const std::vector<SystemStatement>& more, const ast::Block& block) {
    statements = effective(statements);
    std::unordered_set<std::string> said;  // The subjects of the derived block's own statements.
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
        // Texts for readers, such as the title, come from the first base.
        const bool is_for_readers = is_setting_of(SettingBlock::system, statement.name.text);
        if (other == by_subject.end()) {
            statements.push_back(each);
        } else if (is_for_readers) {
            continue;
        } else if (text_of(*other->second) != text_of(statement) && !said.contains(subject)) {
            Diagnostic diagnostic;
            diagnostic.span = block.joined.empty() ? block.base.span : block.joined.front().span;
            diagnostic.message = fmt::format("the bases of '{}' give different values to '{}'",
                                             block.name.text, statement.name.text);
            diagnostic.hint = fmt::format("decide in {}: {}", block.name.text, text_of(statement));
            diagnostic.notes.push_back({other->second->name.span, "one value is here"});
            diagnostic.notes.push_back({statement.name.span, "the other is here"});
            work.diagnostics.add(std::move(diagnostic));
        }
    }
}

constexpr std::size_t most_statements = 1'000'000;

class Derivation {
public:
    Derivation(Workspace& work, const std::vector<SystemBlock>& blocks)
        : work_(work), blocks_(blocks) {
        for (std::uint32_t i = 0; i < blocks.size(); ++i) {
            auto& names = blocks[i].built_in ? library_ : own_;
            names.try_emplace(blocks[i].block->name.text, i);
        }
    }

    std::vector<DerivedSystem> run();

private:
    std::optional<std::uint32_t> find_base(std::uint32_t index, const ast::Word& base);
    void take_base(DerivedSystem& system, std::size_t place,
                   const std::vector<DerivedSystem>& before);
    void report_cycle(const std::vector<std::uint32_t>& cycle);
    DerivedSystem derive(std::uint32_t index, const std::vector<DerivedSystem>& before);

    Workspace& work_;
    const std::vector<SystemBlock>& blocks_;
    std::unordered_map<std::string_view, std::uint32_t> own_, library_;
    /// For each block, its bases in the order of the script.
    std::vector<std::vector<std::uint32_t>> bases_;
    std::vector<bool> is_known_;
    std::vector<std::size_t> places_;  ///< For each block, its index in the result.
    std::size_t copied_ = 0;
};

/// The block to which the name of a base refers. Reports errors.
std::optional<std::uint32_t> Derivation::find_base(std::uint32_t index, const ast::Word& base) {
    if (base.empty()) return std::nullopt;
    const auto own = own_.find(base.text);
    const auto library = library_.find(base.text);
    const bool changes_library =
        base.text == blocks_[index].block->name.text && library != library_.end();
    std::optional<std::uint32_t> found;
    if (own != own_.end() && !blocks_[index].built_in && !changes_library) {
        found = own->second;
    } else if (library != library_.end()) {
        found = library->second;
    }
    const bool has_cells = blocks_[index].block->is_cells;
    if (found && blocks_[*found].block->is_cells == has_cells) {
        note_use(work_, base.span, blocks_[*found].block->name.span);
        return found;
    }
    is_known_[index] = false;
    if (!found && blocks_[index].block->kind == ast::BlockKind::shape) {
        report_unknown_shape(work_, *blocks_[index].script, base);
    } else if (!found) {
        if (!lacks_names(*blocks_[index].script)) report_unknown_system(work_, base);
    } else if (has_cells) {
        work_.diagnostics.error(base.span,
                                fmt::format("cells cannot be derived from '{}', "
                                            "because it is a system of fields",
                                            base.text),
                                "name a block of cells");
    } else {
        work_.diagnostics.error(base.span,
                                fmt::format("a system cannot be derived from '{}', "
                                            "because it is a block of cells",
                                            base.text),
                                "write 'cells' in place of 'system'");
    }
    return std::nullopt;
}

void Derivation::report_cycle(const std::vector<std::uint32_t>& cycle) {
    std::vector<std::string> names;
    for (const std::uint32_t system : cycle) {
        is_known_[system] = false;
        names.emplace_back(blocks_[system].block->name.text);
    }
    work_.diagnostics.error(blocks_[cycle[0]].block->base.span,
                            cycle.size() == 1
                                ? fmt::format("'{}' is derived from itself", names[0])
                                : fmt::format("{} are derived from each other in a cycle: {}",
                                              blocks_[cycle[0]].block->kind == ast::BlockKind::shape
                                                  ? "shapes"
                                                  : "systems",
                                              describe_cycle(names)));
}

/// Adds the statements of a base to a system.
void Derivation::take_base(DerivedSystem& system, std::size_t place,
                           const std::vector<DerivedSystem>& before) {
    const DerivedSystem& base = before[place];
    system.is_known = system.is_known && base.is_known;
    if (copied_ <= most_statements && copied_ + base.statements.size() > most_statements) {
        work_.diagnostics.error(system.from.block->base.span,
                                "the systems of this script are too large in total");
    }
    copied_ += base.statements.size();
    if (copied_ > most_statements) {
        system.is_known = false;
    } else if (!system.base) {
        system.statements = base.statements;
    } else {
        join_statements(work_, system.statements, base.statements, *system.from.block);
    }
    if (!system.base) {
        system.base = place;
    } else {
        system.joined.push_back(place);
    }
}

DerivedSystem Derivation::derive(std::uint32_t index, const std::vector<DerivedSystem>& before) {
    DerivedSystem system;
    system.from = blocks_[index];
    system.is_known = is_known_[index];
    for (const std::uint32_t base : bases_[index]) {
        if (system.is_known) take_base(system, places_[base], before);
    }
    const std::uint32_t level = system.statements.empty() ? 0 : system.statements.back().level + 1;
    for (const ast::Statement& statement : system.from.block->statements) {
        system.statements.push_back({system.from.script, &statement, level});
    }
    return system;
}

std::vector<DerivedSystem> Derivation::run() {
    is_known_.assign(blocks_.size(), true);
    Dependencies reads(blocks_.size());
    for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
        bases_.emplace_back();
        std::vector<ast::Word> words{blocks_[i].block->base};
        words.insert(words.end(), blocks_[i].block->joined.begin(), blocks_[i].block->joined.end());
        for (const ast::Word& word : words) {
            if (const auto base = find_base(i, word)) bases_[i].push_back(*base);
        }
        reads[i] = bases_[i];
    }
    const Order order = topological_order(reads);
    for (const auto& cycle : order.cycles) report_cycle(cycle);
    places_.assign(blocks_.size(), 0);
    std::vector<DerivedSystem> systems;
    for (const std::uint32_t index : order.order) {
        places_[index] = systems.size();
        systems.push_back(derive(index, systems));
    }
    return systems;
}

}  // namespace

std::vector<DerivedSystem> derive_systems(Workspace& work, const std::vector<SystemBlock>& blocks) {
    return Derivation(work, blocks).run();
}

}  // namespace cascade::checking
