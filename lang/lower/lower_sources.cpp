// What formulas read: items through slots, coordinates, and the keys of random numbers.
#include "core/check.h"
#include "core/hash.h"
#include "lang/lower/lower_formula.h"

#include <fmt/format.h>

namespace cascade {

SlotSource::Kind slot_of_text(Function function) {
    switch (function) {
        case Function::image: return SlotSource::Kind::image;
        case Function::attr: return SlotSource::Kind::attribute;
        case Function::uvimage: return SlotSource::Kind::texture;
        default: return SlotSource::Kind::file;
    }
}

}  // namespace cascade

namespace cascade::lowering {

std::uint64_t random_key(std::uint32_t seed, std::string_view stage, std::string_view origin,
                         std::size_t occurrence) {
    std::uint64_t key = fnv1a(fmt::format("{}\n", seed));
    key = fnv1a(fmt::format("{}\n", stage), key);
    key = fnv1a(fmt::format("{}\n", origin), key);
    return fnv1a(fmt::format("{}\n", occurrence), key);
}

KernelAssembly::KernelAssembly(const Program& program, std::uint32_t stage)
    : program_(program), stage_(stage), builder_(program.domain.precision) {}

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

std::uint32_t KernelAssembly::surface_value_slot(std::uint32_t number) {
    // The numbers of a long list would not fit into a name; this one is as unlike the others.
    const std::uint32_t slot = builder_.field_slot(fmt::format(
        "({} {})", info(program_.literals->surface_values()[number].function).spelling, number));
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::surface_value, 0, number});
    }
    return slot;
}

std::uint32_t KernelAssembly::file_slot(Function function, std::uint32_t text) {
    const std::uint32_t slot = builder_.field_slot(
        fmt::format("{}(\"{}\")", info(function).spelling, program_.literals->texts()[text]));
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({slot_of_text(function), 0, text});
    }
    return slot;
}

std::uint32_t KernelAssembly::metric_slot(std::uint32_t plane) {
    static constexpr std::array<const char*, metric_plane_count> names{"(metric 11)", "(metric 12)",
                                                                       "(metric 22)", "(area)",
                                                                       "(flow 11)",   "(flow 12)",
                                                                       "(flow 22)"};
    const std::uint32_t slot = builder_.field_slot(names[plane]);
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::metric, 0, plane});
    }
    return slot;
}

std::uint32_t KernelAssembly::model_slot(ModelPlane plane) {
    static constexpr std::array<const char*, model_plane_count> names{"(number)",
                                                                      "(area)",
                                                                      "(x)",
                                                                      "(y)",
                                                                      "(z)",
                                                                      "(sx)",
                                                                      "(sy)",
                                                                      "(sz)",
                                                                      "(nx)",
                                                                      "(ny)",
                                                                      "(nz)",
                                                                      "(curvature)",
                                                                      "(curvature_mean)",
                                                                      "(curvature_high)",
                                                                      "(curvature_low)",
                                                                      "(curvature_gauss)"};
    const auto number = static_cast<std::uint32_t>(plane);
    const std::uint32_t slot = builder_.field_slot(names[number]);
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::model, 0, number});
    }
    return slot;
}

ValueId KernelAssembly::of_model(ModelPlane plane) { return beside(model_slot(plane)); }

/// A bit for each of the cells around and for the cell itself, by the numbers of their offsets.
ValueId KernelAssembly::inside(Offset offset) {
    const std::uint32_t slot = builder_.field_slot("(neighbourhood)");
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::neighbourhood, 0, 0});
    }
    const ValueId bit =
        builder_.apply(Op::bits_and, builder_.field(slot), builder_.word(only(offset)));
    return builder_.apply(Op::bits_to_number, bit);
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

std::uint32_t KernelAssembly::temporary_slot(std::uint32_t temporary) {
    // No name of the language begins with a bracket.
    const std::uint32_t slot = builder_.field_slot(fmt::format("(temporary {})", temporary));
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::temporary, 0, temporary});
    }
    return slot;
}

std::uint32_t KernelAssembly::step_invariant_slot(std::uint32_t number) {
    const std::uint32_t slot = builder_.field_slot(fmt::format("(step-invariant {})", number));
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::step_invariant, stage_, number});
    }
    return slot;
}

ValueId KernelAssembly::step_invariant_number(std::uint32_t number) {
    return uniform(fmt::format("(step-invariant {})", number),
                   {SlotSource::Kind::step_invariant, stage_, number});
}

ValueId KernelAssembly::aggregate(std::uint32_t index) {
    return uniform(fmt::format("(aggregate {})", index), {SlotSource::Kind::aggregate, 0, index});
}

ValueId KernelAssembly::coefficient(std::uint32_t index) {
    return uniform(fmt::format("(coefficient {})", index),
                   {SlotSource::Kind::coefficient, 0, index});
}

std::uint32_t KernelAssembly::input_slot(std::uint32_t input, std::uint32_t item) {
    if (input == 0) return field_slot(stage_, item);
    const std::uint32_t slot =
        builder_.field_slot(fmt::format("{} (input {})", slot_name(stage_, item), input));
    if (slot == bound_.fields.size()) {
        bound_.fields.push_back({SlotSource::Kind::input, input, item});
    }
    return slot;
}

ValueId KernelAssembly::input(std::uint32_t input, std::uint32_t item) {
    return builder_.field(input_slot(input, item));
}

std::uint32_t KernelAssembly::plane_slot(const PartGraph& graph, PartId id) {
    const Part& part = graph[id];
    if (part.node.kind == NodeKind::own) return field_slot(stage_, part.node.index);
    if (part.node.kind == NodeKind::earlier) return field_slot(part.node.stage, part.node.index);
    if (part.node.kind == NodeKind::metric) return metric_slot(part.node.index);
    if (part.node.kind == NodeKind::model)
        return model_slot(static_cast<ModelPlane>(part.node.index));
    if (part.node.kind == NodeKind::surface_value) return surface_value_slot(part.node.index);
    CHECK(part.node.kind == NodeKind::call && reads_file(part.node.function),
          "lowering: a plane is an item or a file");
    return file_slot(part.node.function, graph[part.operands[0]].node.index);
}

ValueId KernelAssembly::item(std::uint32_t stage, std::uint32_t item) {
    const SlotSource source{SlotSource::Kind::item, stage, item};
    if (program_.stages[stage].uniform[item]) return uniform(slot_name(stage, item), source);
    const bool is_frozen = stage == stage_ && item == program_.system_of(stage).frozen_item();
    if (is_frozen && frozen_is_mask_) return mask(item);
    return beside(field_slot(stage, item));
}

/// The stage's speed, unless the time loop gives steps another length.
ValueId KernelAssembly::time_step() {
    const StageTime& time = stage().time;
    if (!time.has_duration() && !time.chooses_steps()) return own_item(system().speed_item());
    return uniform("time step", {SlotSource::Kind::time_step, stage_, 0});
}

/// One time for all cells is kept by the time loop.
ValueId KernelAssembly::time() {
    const std::uint32_t speed = system().speed_item();
    if (stage().uniform[speed]) return uniform("t", {SlotSource::Kind::time, stage_, 0});
    return builder_.multiply(step(), time_step());
}

ValueId KernelAssembly::step() { return uniform("step", {SlotSource::Kind::step, stage_, 0}); }

/// Cell centres: (i + 1/2) / side.
ValueId KernelAssembly::coordinate(ValueId cell, std::int64_t side) {
    const ValueId number = builder_.apply(Op::bits_to_number, cell);
    const ValueId centre = builder_.add(number, builder_.number(0.5));
    const ValueId place = builder_.divide(centre, builder_.number(static_cast<double>(side)));
    builder_.keep(place);  // Where a cell lies is one number everywhere.
    return place;
}

/// The number of a cell beside, along one axis: beyond a side that of the opposite one, or of the
/// cell at the side.
ValueId KernelAssembly::wrapped(ValueId cell, int by, std::int64_t count, Boundary boundary) {
    if (by == 0) return cell;
    const std::int64_t first = 0;
    const std::int64_t last = count - 1;
    const std::int64_t at_side = by > 0 ? last : first;
    const std::int64_t opposite = by > 0 ? first : last;
    const ValueId moved =
        builder_.apply(by > 0 ? Op::bits_add : Op::bits_subtract, cell, builder_.word(1));
    const ValueId is_at_side = builder_.apply(Op::equal, builder_.apply(Op::bits_to_number, cell),
                                              builder_.number(static_cast<double>(at_side)));
    const std::int64_t beyond = boundary == Boundary::periodic ? opposite : at_side;
    return builder_.select(is_at_side, builder_.word(static_cast<std::uint32_t>(beyond)), moved);
}

ValueId KernelAssembly::column() {
    const Grid& grid = program_.domain.grid;
    return wrapped(builder_.cell_column(), at_.dx, grid.width, grid.boundary.x);
}

ValueId KernelAssembly::row() {
    const Grid& grid = program_.domain.grid;
    return wrapped(builder_.cell_row(), at_.dy, grid.height, grid.boundary.y);
}

ValueId KernelAssembly::slice() {
    const Grid& grid = program_.domain.grid;
    return wrapped(builder_.cell_slice(), at_.dz, grid.depth, grid.boundary.z);
}

ValueId KernelAssembly::builtin(Builtin builtin) {
    const auto [known, is_new] = builtins_.try_emplace({at_.number(), builtin});
    if (is_new) known->second = make_builtin(builtin);
    return known->second;
}

ValueId KernelAssembly::make_builtin(Builtin builtin) {
    const Grid& grid = program_.domain.grid;
    if (program_.domain.model) {
        if (const auto plane = model_plane_of(builtin)) return of_model(*plane);
    }
    switch (builtin) {
        case Builtin::x: return coordinate(column(), grid.longest_side());
        case Builtin::y: return coordinate(row(), grid.longest_side());
        case Builtin::sx: return coordinate(column(), grid.width);
        case Builtin::sy: return coordinate(row(), grid.height);
        case Builtin::z: return coordinate(slice(), grid.longest_side());
        case Builtin::sz: return coordinate(slice(), grid.depth);
        case Builtin::t: return time();
        case Builtin::step: return step();
        // A plane lies flat, and looks up.
        case Builtin::nx:
        case Builtin::ny:
        case Builtin::curvature:
        case Builtin::curvature_mean:
        case Builtin::curvature_gauss:
        case Builtin::curvature_high:
        case Builtin::curvature_low: return builder_.number(0);
        case Builtin::nz: return builder_.number(1);
    }
    CHECK(false, "lowering: every built-in value has a meaning");
}

BoundKernel KernelAssembly::finish(std::vector<std::uint32_t> results) && {
    bound_.kernel = std::move(builder_).finish();
    bound_.results = std::move(results);
    return std::move(bound_);
}

}  // namespace cascade::lowering
