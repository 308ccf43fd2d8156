// Orders systems topologically by their bases, reports cycles, and puts the statements of a base
// before those of the system derived from it.
#include "lang/check/system_inheritance.h"

#include "lang/check/check_blocks.h"
#include "lang/check/check_cycles.h"
#include "lang/program/order.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

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
    std::optional<std::uint32_t> find_base(std::uint32_t index);
    void report_cycle(const std::vector<std::uint32_t>& cycle);
    DerivedSystem derive(std::uint32_t index, const std::vector<DerivedSystem>& before);

    Workspace& work_;
    const std::vector<SystemBlock>& blocks_;
    std::unordered_map<std::string_view, std::uint32_t> own_, library_;
    std::vector<std::optional<std::uint32_t>> bases_;
    std::vector<bool> is_known_;
    std::vector<std::size_t> places_;  ///< The index in the result, by block.
    std::size_t copied_ = 0;
};

std::optional<std::uint32_t> Derivation::find_base(std::uint32_t index) {
    const ast::Word& base = blocks_[index].block->base;
    if (base.empty()) return std::nullopt;
    const auto own = own_.find(base.text);
    const auto library = library_.find(base.text);
    const bool changes_library =
        base.text == blocks_[index].block->name.text && library != library_.end();
    if (own != own_.end() && !blocks_[index].built_in && !changes_library) return own->second;
    if (library != library_.end()) return library->second;
    is_known_[index] = false;
    report_unknown_system(work_, base);
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
                                : fmt::format("systems are derived from each other in a cycle: {}",
                                              describe_cycle(names)));
}

DerivedSystem Derivation::derive(std::uint32_t index, const std::vector<DerivedSystem>& before) {
    DerivedSystem system;
    system.from = blocks_[index];
    system.is_known = is_known_[index];
    std::uint32_t level = 0;
    if (bases_[index] && system.is_known) {
        system.base = places_[*bases_[index]];
        const DerivedSystem& base = before[*system.base];
        system.is_known = base.is_known;
        if (copied_ <= most_statements && copied_ + base.statements.size() > most_statements) {
            work_.diagnostics.error(system.from.block->base.span,
                                    "the systems of this script are too large together");
        }
        copied_ += base.statements.size();
        if (copied_ > most_statements) {
            system.is_known = false;
        } else if (!base.statements.empty()) {
            system.statements = base.statements;
            level = base.statements.back().level + 1;
        }
    }
    for (const ast::Statement& statement : system.from.block->statements) {
        system.statements.push_back({system.from.script, &statement, level});
    }
    return system;
}

std::vector<DerivedSystem> Derivation::run() {
    is_known_.assign(blocks_.size(), true);
    Dependencies reads(blocks_.size());
    for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
        bases_.push_back(find_base(i));
        if (bases_[i]) reads[i].push_back(*bases_[i]);
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
