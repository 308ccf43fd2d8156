// Collects a system's statements by following its bases in the syntax tree. Needs no checked
// script, so the equations of any script can be printed.
#include "lang/library/system_statements.h"

#include "lang/library/library.h"
#include "lang/syntax/index_words.h"
#include "lang/syntax/parse.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <unordered_map>

namespace cascade {

namespace {

bool is_rate(const ast::Statement& statement) {
    return statement.kind == ast::StatementKind::rate ||
           statement.kind == ast::StatementKind::rate_term;
}

/// "[2]" for a statement about one member of a family, "[i,2]" for a statement about some members,
/// else "".
std::string member_of(const ast::Statement& statement) {
    if (!is_of_some_members(statement.index)) return "";
    return fmt::format("[{}]", statement.index.text);
}

SaidStatement said(const ast::Script& script, const Sources& sources,
                   const ast::Statement& statement) {
    SaidStatement result{&script, &sources, &statement};
    if (!statement.doc.empty()) result.doc = &statement;
    if (statement.range) {
        result.range = &statement;
        result.range_script = &script;
        result.range_sources = &sources;
    }
    return result;
}

}  // namespace

std::string subject_of(const ast::Statement& statement) {
    auto kind = is_rate(statement) ? ast::StatementKind::rate : statement.kind;
    if (kind == ast::StatementKind::definition) kind = ast::StatementKind::value;
    return fmt::format("{} {} {}", static_cast<int>(kind), statement.name.text,
                       statement.after.text);
}

SystemBlocks system_blocks(const ast::Script& script) {
    SystemBlocks blocks;
    for (const ast::Block& block : script.blocks) {
        if (block.kind == ast::BlockKind::system) blocks.try_emplace(block.name.text, &block);
    }
    return blocks;
}

SystemStatements::SystemStatements(const ast::Script& script, const Sources& sources,
                                   const SystemBlocks& blocks, std::string_view system) {
    FoundBlock first = find_block({&script, &sources, &blocks, nullptr}, system);
    if (first.block == nullptr) first = find_in_library(system);
    found_ = first.block != nullptr;
    if (found_) {
        doc_ = first.block->doc;
        is_cells_ = first.block->is_cells;
    }
    // Visits blocks depth first: a block is added after all its bases, and only once.
    struct Open {
        FoundBlock found;
        std::size_t bases_taken = 0;
    };
    std::vector<Open> open;
    std::unordered_set<const ast::Block*> seen{first.block};
    if (found_) open.push_back({first});
    while (!open.empty()) {
        const FoundBlock found = open.back().found;
        const std::size_t next = open.back().bases_taken++;
        const auto& joined = found.block->joined;
        if (next > joined.size() || found.block->base.empty()) {
            derive(found);
            open.pop_back();
            continue;
        }
        const ast::Word& base = next == 0 ? found.block->base : joined[next - 1];
        // In `system a: a { … }` the base is the library's a.
        const bool is_own_name = base.text == found.block->name.text;
        FoundBlock other = is_own_name ? FoundBlock{} : find_block(found, base.text);
        if (other.block == nullptr) other = find_in_library(base.text);
        if (other.block != nullptr && seen.insert(other.block).second) open.push_back({other});
    }
    for (const SaidStatement& each : statements_) {
        if (is_rate(*each.statement)) species_.insert(each.statement->name.text);
    }
}

/// Adds the statements of a block. Some of these replace inherited statements.
void SystemStatements::derive(const FoundBlock& found) {
    struct Change {
        /// The first inherited statement that the statement replaces.
        std::size_t first = SIZE_MAX;
        bool is_used = false;
    };
    std::unordered_map<std::string, Change> changes;
    for (const ast::Statement& statement : found.block->statements) {
        if (statement.kind == ast::StatementKind::rate_term) continue;
        changes.try_emplace(subject_of(statement) + member_of(statement));
    }
    std::vector<bool> dropped(statements_.size(), false);
    for (std::size_t k = 0; k < statements_.size(); ++k) {
        const ast::Statement& inherited = *statements_[k].statement;
        // A statement about all members of a family also replaces statements about a single member.
        for (const std::string& member : {std::string(), member_of(inherited)}) {
            const auto change = changes.find(subject_of(inherited) + member);
            if (change == changes.end()) continue;
            dropped[k] = true;
            if (change->second.first == SIZE_MAX) change->second.first = k;
        }
    }
    for (const ast::Statement& statement : found.block->statements) {
        SaidStatement added = said(*found.script, *found.sources, statement);
        const auto change = changes.find(subject_of(statement) + member_of(statement));
        const bool takes_place = statement.kind != ast::StatementKind::rate_term &&
                                 change != changes.end() && !change->second.is_used &&
                                 change->second.first != SIZE_MAX;
        if (!takes_place) {
            statements_.push_back(added);
            dropped.push_back(false);
            continue;
        }
        change->second.is_used = true;
        SaidStatement& before = statements_[change->second.first];
        if (added.doc == nullptr) added.doc = before.doc;
        if (added.range == nullptr) {
            added.range = before.range;
            added.range_script = before.range_script;
            added.range_sources = before.range_sources;
        }
        before = added;
        dropped[change->second.first] = false;
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < statements_.size(); ++k) {
        if (!dropped[k]) statements_[kept++] = statements_[k];
    }
    statements_.resize(kept);
}

SystemStatements::FoundBlock SystemStatements::find_block(FoundBlock beside,
                                                          std::string_view system) {
    const auto found = beside.blocks->find(system);
    beside.block = found == beside.blocks->end() ? nullptr : found->second;
    return beside;
}

SystemStatements::FoundBlock SystemStatements::find_in_library(std::string_view system) {
    const LibraryText* const text = find_library_text(system);
    if (text == nullptr) return {};
    LibraryScript& read = library_.emplace_back();
    Diagnostics never_any;
    const SourceId source = read.sources.add(std::string(text->file_name), std::string(text->text));
    read.script = parse(source, read.sources, never_any);
    read.blocks = system_blocks(read.script);
    return find_block({&read.script, &read.sources, &read.blocks, nullptr}, system);
}

}  // namespace cascade
