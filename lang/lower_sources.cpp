// What formulas read: items through slots, coordinates, and the keys of random numbers.
#include "core/check.h"
#include "core/hash.h"
#include "lang/lower_formula.h"

#include <fmt/format.h>

namespace cascade::lowering {

std::uint64_t random_key(std::uint32_t seed, std::string_view stage, std::string_view origin,
                         std::size_t occurrence) {
    std::uint64_t key = fnv1a(fmt::format("{}\n", seed));
    key = fnv1a(fmt::format("{}\n", stage), key);
    key = fnv1a(fmt::format("{}\n", origin), key);
    return fnv1a(fmt::format("{}\n", occurrence), key);
}

KernelAssembly::KernelAssembly(const Program& program, std::uint32_t stage)
    : program_(program), stage_(stage) {}

/// Items of other stages are written large.b. No name of the language holds a dot, so the two kinds
/// of slot names cannot meet.
std::string KernelAssembly::slot_name(std::uint32_t stage, std::uint32_t item) const {
    const std::string_view name = program_.system_of(stage).item_name(item);
    if (stage == stage_) return std::string(name);
    return fmt::format("{}.{}", program_.stages[stage].name, name);
}

std::uint32_t KernelAssembly::field_slot(std::uint32_t stage, std::uint32_t item) {
    const std::uint32_t slot = builder_.field_slot(slot_name(stage, item));
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::item, stage, item});
    }
    return slot;
}

ValueId KernelAssembly::file(std::uint32_t text) {
    const std::uint32_t slot =
        builder_.field_slot(fmt::format("field(\"{}\")", program_.texts[text]));
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::file, 0, text});
    }
    return builder_.field(slot);
}

ValueId KernelAssembly::mask(std::uint32_t item) {
    const std::uint32_t slot = builder_.mask_slot(slot_name(stage_, item));
    if (slot == bound_.masks.size()) {
        bound_.masks.push_back({SlotSource::Kind::item, stage_, item});
    }
    return builder_.mask(slot);
}

ValueId KernelAssembly::uniform(const std::string& name, const SlotSource& source) {
    const std::uint32_t slot = builder_.uniform_slot(name);
    if (slot == bound_.uniforms.size()) bound_.uniforms.push_back(source);
    return builder_.uniform(slot);
}

ValueId KernelAssembly::item(std::uint32_t stage, std::uint32_t item) {
    if (stage == stage_) {
        const auto known = own_.find(item);
        if (known != own_.end()) return known->second;
    }
    const SlotSource source{SlotSource::Kind::item, stage, item};
    if (program_.stages[stage].uniform[item]) return uniform(slot_name(stage, item), source);
    const bool is_frozen = stage == stage_ && item == program_.system_of(stage).frozen_item();
    if (is_frozen && frozen_is_mask_) return mask(item);
    return builder_.field(field_slot(stage, item));
}

ValueId KernelAssembly::time_step() { return own_item(system().speed_item()); }

ValueId KernelAssembly::step() { return uniform("step", {SlotSource::Kind::step, stage_, 0}); }

/// Cell centres: (i + 1/2) / side.
ValueId KernelAssembly::coordinate(ValueId cell, std::int64_t side) {
    const ValueId number = builder_.apply(Op::bits_to_number, cell);
    const ValueId centre = builder_.add(number, builder_.number(0.5f));
    return builder_.divide(centre, builder_.number(static_cast<float>(side)));
}

ValueId KernelAssembly::builtin(Builtin builtin) {
    auto& known = builtins_[static_cast<std::size_t>(builtin)];
    if (!known) known = make_builtin(builtin);
    return *known;
}

ValueId KernelAssembly::make_builtin(Builtin builtin) {
    const Grid& grid = program_.domain.grid;
    switch (builtin) {
        case Builtin::x: return coordinate(builder_.cell_column(), grid.longest_side());
        case Builtin::y: return coordinate(builder_.cell_row(), grid.longest_side());
        case Builtin::sx: return coordinate(builder_.cell_column(), grid.width);
        case Builtin::sy: return coordinate(builder_.cell_row(), grid.height);
        case Builtin::z: return coordinate(builder_.cell_slice(), grid.longest_side());
        case Builtin::sz: return coordinate(builder_.cell_slice(), grid.depth);
        case Builtin::t: return builder_.multiply(step(), time_step());
        case Builtin::step: return step();
    }
    CHECK(false, "lowering: every built-in value has a meaning");
}

BoundKernel KernelAssembly::finish(std::vector<std::uint32_t> results) && {
    bound_.kernel = std::move(builder_).finish();
    bound_.results = std::move(results);
    return std::move(bound_);
}

}  // namespace cascade::lowering
