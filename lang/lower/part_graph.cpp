// Formulas to parts: one loop over the nodes of each, equal parts found by a hash.
#include "lang/lower/part_graph.h"

#include "core/check.h"

#include <bit>
#include <limits>

namespace cascade::lowering {

namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
    return (hash ^ word) * 0x100000001b3ULL ^ (hash >> 29);
}

std::uint64_t hash_of(const Part& part) {
    const Node& node = part.node;
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    hash = mix(hash, static_cast<std::uint64_t>(node.kind) << 8 |
                         static_cast<std::uint64_t>(node.function));
    hash = mix(hash, std::bit_cast<std::uint64_t>(node.number));
    hash = mix(hash, std::uint64_t{node.index} << 32 | node.stage);
    for (std::uint32_t k = 0; k < part.operand_count; ++k) hash = mix(hash, part.operands[k]);
    return hash;
}

bool is_same(const Part& a, const Part& b) {
    return a.node.kind == b.node.kind && a.node.function == b.node.function &&
           a.node.type == b.node.type && a.node.index == b.node.index &&
           a.node.stage == b.node.stage &&
           std::bit_cast<std::uint64_t>(a.node.number) ==
               std::bit_cast<std::uint64_t>(b.node.number) &&
           a.operands == b.operands && a.operand_count == b.operand_count;
}

}  // namespace

bool PartGraph::is_uniform(const Part& part) const {
    bool operand_differs = false;
    for (std::uint32_t k = 0; k < part.operand_count; ++k) {
        operand_differs = operand_differs || !parts_[part.operands[k]].is_uniform;
    }
    return !differs_by_cell(part.node, operand_differs, program_, stage_);
}

/// Parameters keep the values that they have when the stage starts, and earlier stages are over.
bool PartGraph::is_step_invariant(const Part& part) const {
    switch (part.node.kind) {
        case NodeKind::own:
            return step_invariant_ == Invariance::state ||
                   !program_.system_of(stage_).is_species(part.node.index);
        case NodeKind::builtin: {
            const auto builtin = static_cast<Builtin>(part.node.index);
            return builtin != Builtin::t && builtin != Builtin::step;
        }
        case NodeKind::definition:
        case NodeKind::rate: return false;
        case NodeKind::number:
        case NodeKind::text:
        case NodeKind::earlier:
        case NodeKind::metric:
        case NodeKind::model:
        case NodeKind::surface_value:
        case NodeKind::inside: return true;
        case NodeKind::call: break;
    }
    if (is_random(part.node.function) && step_invariant_ != Invariance::state) return false;
    for (std::uint32_t k = 0; k < part.operand_count; ++k) {
        if (!parts_[part.operands[k]].is_step_invariant) return false;
    }
    return true;
}

bool PartGraph::is_plane(PartId id) const {
    const Part& part = parts_[id];
    if (part.is_uniform) return false;
    switch (part.node.kind) {
        case NodeKind::own: return part.node.index != program_.system_of(stage_).frozen_item();
        case NodeKind::earlier:
        case NodeKind::metric:
        case NodeKind::surface_value:
        case NodeKind::model: return true;
        case NodeKind::call: return reads_file(part.node.function);
        default: return false;
    }
}

/// What an aggregate over the domain takes of the grid: outside of the mask what changes nothing.
PartId PartGraph::inside_mask(PartId of, Function aggregate) {
    const bool adds = aggregate == Function::domain_sum || aggregate == Function::domain_mean;
    const NodeKind kind = parts_[of].node.kind;
    const bool is_item = kind == NodeKind::own || kind == NodeKind::earlier;
    // Items that vary are 0 there.
    if (adds && is_item && !parts_[of].is_uniform) return of;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Part inside, neutral;
    inside.node.kind = NodeKind::inside;
    neutral.node.number = adds ? 0 : aggregate == Function::domain_min ? infinity : -infinity;
    return call(Function::if_, {intern(inside), of, intern(neutral)});
}

PartId PartGraph::intern(Part part) {
    const bool is_aggregate =
        part.node.kind == NodeKind::call && info(part.node.function).is_aggregate;
    if (has_mask_ && is_aggregate) {
        part.operands[0] = inside_mask(part.operands[0], part.node.function);
    }
    const bool is_own = is_draw(part.node);
    const std::uint64_t hash = hash_of(part);
    if (!is_own) {
        const auto [first, last] = known_.equal_range(hash);
        for (auto found = first; found != last; ++found) {
            if (is_same(parts_[found->second], part)) return found->second;
        }
    }
    const auto id = static_cast<PartId>(parts_.size());
    parts_.push_back(part);
    parts_.back().is_uniform = is_uniform(part);
    parts_.back().is_step_invariant = is_step_invariant(part);
    parts_.back().beyond = beyond(parts_.back());
    if (!is_own) known_.emplace(hash, id);
    return id;
}

PartId PartGraph::item(std::uint32_t item) {
    Part part;
    part.node.kind = NodeKind::own;
    part.node.index = item;
    return intern(part);
}

void PartGraph::set_definition(std::uint32_t index, PartId part) {
    definitions_[index] = part;
    names_.try_emplace(part, program_.system_of(stage_).definitions[index].name);
}

void PartGraph::set_rate(std::uint32_t item, PartId part) {
    rates_[item] = part;
    names_.try_emplace(part, program_.system_of(stage_).quantities[item].name + "'");
}

const std::string& PartGraph::name(PartId part) const {
    static const std::string none;
    const auto found = names_.find(part);
    return found == names_.end() ? none : found->second;
}

PartId PartGraph::call(Function function, std::initializer_list<PartId> operands, ValueType type) {
    Part part;
    part.node.kind = NodeKind::call;
    part.node.function = function;
    part.node.type = type;
    for (const PartId operand : operands) part.operands[part.operand_count++] = operand;
    part.node.operand_count = static_cast<std::uint8_t>(part.operand_count);
    return intern(part);
}

/// A = R(θ) diag(a1², a2²) Rᵀ(θ), y down (Witkin & Kass, eq 6; its direction [cos θ, sin θ] and the
/// sign of its a12 agree when y points down). The operands become a11, a12 and a22, so that they
/// are parts like all others.
PartId PartGraph::tensor(const Part& part) {
    const auto square = [&](PartId of) { return call(Function::multiply, {of, of}); };
    const PartId along = square(part.operands[0]);
    const PartId across = square(part.operands[1]);
    const PartId cosine = call(Function::cos, {part.operands[2]});
    const PartId sine = call(Function::sin, {part.operands[2]});
    const PartId cosine2 = square(cosine);
    const PartId sine2 = square(sine);
    const auto times = [&](PartId a, PartId b) { return call(Function::multiply, {a, b}); };
    const PartId a11 = call(Function::add, {times(along, cosine2), times(across, sine2)});
    const PartId a22 = call(Function::add, {times(along, sine2), times(across, cosine2)});
    const PartId a12 = times(call(Function::subtract, {along, across}), times(sine, cosine));
    return call(Function::tensor, {a11, a12, a22}, ValueType::tensor);
}

PartId PartGraph::add(const Formula& formula, const Noise& noise) {
    CHECK(!formula.nodes.empty(), "lowering: a checked formula has parts");
    noises_.push_back(noise);
    const Noise* const origin = &noises_.back();
    std::vector<PartId> ids;
    ids.reserve(formula.nodes.size());
    std::size_t draws = 0;
    for (const Node& node : formula.nodes) {
        Part part;
        part.node = node;
        part.formula = &formula;
        part.position = static_cast<std::uint32_t>(ids.size());
        switch (node.kind) {
            case NodeKind::definition: ids.push_back(definitions_.at(node.index)); continue;
            case NodeKind::rate: ids.push_back(rates_.at(node.index)); continue;
            case NodeKind::own:
                if (const auto known = own_.find(node.index); known != own_.end()) {
                    ids.push_back(known->second);
                    continue;
                }
                break;
            case NodeKind::call:
                part.operand_count = static_cast<std::uint32_t>(operand_count(node));
                for (std::uint32_t k = 0; k < part.operand_count; ++k) {
                    part.operands[k] = ids[node.operands[k]];
                }
                if (is_random(node.function)) {
                    part.noise = origin;
                    part.draw = ++draws;
                }
                break;
            default: break;
        }
        if (part.calls(Function::tensor)) {
            ids.push_back(tensor(part));
            continue;
        }
        if (part.calls(Function::diffuse)) {
            // Operands: the tensor, then what is differentiated.
            Part of;
            for (std::uint32_t k = 0; k < 3; ++k) of.operands[k] = part.operands[k + 1];
            part.operands = {tensor(of), part.operands[0]};
            part.operand_count = part.node.operand_count = 2;
        }
        const bool is_call = part.node.kind == NodeKind::call;
        if (has_model_) {
            ids.push_back(on_model(part));
        } else {
            ids.push_back(has_metric_ && is_call ? on_surface(part) : intern(part));
        }
    }
    return ids.back();
}

}  // namespace cascade::lowering
