// Formulas of cells that crawl: vectors become three numbers each, and sums over neighbours become
// sums over links.
//
// Inside of a sum over neighbours names are the neighbour's, so a node has up to two images: its
// value in the cell (`here`) and its value at the other end of a link (`there`). There, a node that
// reads no value of the link is the neighbour's alone: either `theirs` of its plane, which an
// earlier pass writes, or computed for each link from the planes it is made of, if that is cheap. A
// sum is canonical: the link_sum of a choice between the value and 0 by whether the cells touch.
// Distances and choices are equal nodes of all sums, and kernels compute all sums in one loop over
// links.
#include "lang/lower/graph_passes.h"

#include "core/check.h"
#include "lang/lower/pass_planner.h"
#include "lang/lower/tissue_numbers.h"
#include "lang/program/models.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace cascade::lowering {

namespace {

using Parts = TissueNumbers::Parts;

/// The approximate number of neighbours.
constexpr int usual_links = 8;
constexpr int most_operations = 1 << 20;

bool is_of_neighbours(const Node& node) {
    return node.is<Call>() && (is_over_neighbours(node.function) || node.calls(Function::lap));
}

std::size_t part_count(const Node& node) { return node.type == ValueType::vector ? 3 : 1; }

class TissuePass {
public:
    TissuePass(const Expressions& from, const PassContext& context)
        : from_(from),
          context_(context),
          is_uniform_(uniform_nodes(from.graph, context)),
          numbers_(to_.graph, context_) {}

    Expressions run();

private:
    struct Facts {
        bool is_of_link = false;  ///< It reads a value of the link, or own(e).
        bool stays = false;       ///< It cannot be computed for a neighbour.
        int operations = 0;       ///< That compute it from planes.
        bool read_here = false, read_there = false;
    };

    void find_facts();
    void find_readers();
    bool is_gathered(NodeId id) const;
    Parts here(NodeId id);
    Parts there(NodeId id);
    Parts value_of_link(CellValue value);
    Parts own_value(CellValue value);
    Parts leaf_here(const Node& node);
    Parts combined(NodeId id, std::span<const Parts> operands);
    Parts over_neighbours(const Node& node);
    Parts laplacian(const Node& node);
    NodeId reduced(Function function, NodeId is_close, NodeId value, double otherwise);

    const Expressions& from_;
    PassContext context_;
    IdVector<NodeId, bool> is_uniform_;
    Expressions to_;
    TissueNumbers numbers_;
    IdVector<NodeId, Facts> facts_;
    IdVector<NodeId, Parts> here_, there_;
};

Expressions TissuePass::run() {
    const std::size_t count = from_.graph.size();
    facts_.resize(count);
    here_.resize(count);
    there_.resize(count);
    find_facts();
    find_readers();
    for (const NodeId id : facts_.ids()) {
        if (facts_[id].read_here) here_[id] = here(id);
        if (facts_[id].read_there) there_[id] = there(id);
    }
    for (const NodeId root : from_.roots) {
        for (std::size_t k = 0; k < part_count(from_.graph[root]); ++k) {
            to_.roots.push_back(here_[root][k]);
        }
    }
    static constexpr std::array<const char*, 3> components{".x", ".y", ".z"};
    for (const auto& [id, name] : from_.names) {
        if (!facts_[id].read_here) continue;
        const bool is_number = part_count(from_.graph[id]) == 1;
        for (std::size_t k = 0; k < part_count(from_.graph[id]); ++k) {
            to_.names.emplace_back(here_[id][k], is_number ? name : name + components[k]);
        }
    }
    to_.origins = from_.origins;
    return std::move(to_);
}

void TissuePass::find_facts() {
    for (const NodeId id : facts_.ids()) {
        const Node& node = from_.graph[id];
        Facts& facts = facts_[id];
        if (const auto* value = node.as<CellValue>()) {
            facts.is_of_link = cascade::is_of_link(*value);
        }
        if (!node.is<Call>() || is_uniform_[id]) continue;
        const bool is_sum = is_of_neighbours(node);
        facts.is_of_link = node.calls(Function::own);
        facts.stays = is_sum || (varies_by_cell(node.function) && !differentiates(node.function) &&
                                 !node.calls(Function::own) && !reads_file(node.function));
        facts.operations = operations_of(node) * static_cast<int>(part_count(node));
        for (const NodeId operand : node.reads()) {
            if (is_uniform_[operand]) continue;
            facts.is_of_link |= facts_[operand].is_of_link && !is_sum;
            facts.stays |= facts_[operand].stays;
            facts.operations =
                std::min(facts.operations + facts_[operand].operations, most_operations);
        }
    }
}

/// Is the neighbour's value read from a plane, and not computed for each link? For nodes that vary
/// and are not of the link. Axes of frames are, too: combing six neighbours takes 22 ns per cell by
/// planes of ez, with the pass that writes them, and 26 ns by gathering quaternions.
bool TissuePass::is_gathered(NodeId id) const {
    const Facts& facts = facts_[id];
    return facts.stays || facts.operations == 0 ||
           facts.operations * usual_links > operations_of_writing;
}

void TissuePass::find_readers() {
    for (const NodeId root : from_.roots) facts_[root].read_here = true;
    for (const NodeId id : facts_.ids_backwards()) {
        Facts& facts = facts_[id];
        const Node& node = from_.graph[id];
        const auto read = [&](bool Facts::*reader) {
            for (const NodeId operand : node.reads()) facts_[operand].*reader = true;
        };
        if (facts.read_there && (is_uniform_[id] || (!facts.is_of_link && is_gathered(id)))) {
            facts.read_here = true;
        } else if (facts.read_there) {
            read(node.calls(Function::own) ? &Facts::read_here : &Facts::read_there);
        }
        if (!facts.read_here) continue;
        if (!is_of_neighbours(node)) {
            read(&Facts::read_here);
            continue;
        }
        facts_[node.operands[0]].read_there = true;
        if (node.calls(Function::lap)) facts_[node.operands[0]].read_here = true;
        if (node.operand_count == 2) facts_[node.operands[1]].read_here = true;
    }
}

Parts TissuePass::here(NodeId id) {
    const Node& node = from_.graph[id];
    if (!node.is<Call>()) return leaf_here(node);
    if (node.calls(Function::lap)) return laplacian(node);
    if (is_of_neighbours(node)) return over_neighbours(node);
    std::array<Parts, most_operands> operands{};
    std::ranges::transform(node.reads(), operands.begin(),
                           [&](NodeId operand) { return here_[operand]; });
    return combined(id, {operands.data(), node.operand_count});
}

Parts TissuePass::there(NodeId id) {
    const Node& node = from_.graph[id];
    if (is_uniform_[id]) return here_[id];
    if (!facts_[id].is_of_link && is_gathered(id)) {
        Parts parts = here_[id];
        for (std::size_t k = 0; k < part_count(node); ++k) parts[k] = numbers_.theirs(parts[k]);
        return parts;
    }
    if (node.calls(Function::own)) return here_[node.operands[0]];
    if (const auto* value = node.as<CellValue>()) return value_of_link(*value);
    std::array<Parts, most_operands> operands{};
    std::ranges::transform(node.reads(), operands.begin(),
                           [&](NodeId operand) { return there_[operand]; });
    return combined(id, {operands.data(), node.operand_count});
}

Parts TissuePass::leaf_here(const Node& node) {
    const auto following = [&](const auto& leaf_of) {
        return Parts{leaf_of(0), leaf_of(1), leaf_of(2)};
    };
    const bool is_vector = node.type == ValueType::vector;
    if (const auto* item = node.as<ItemId>(); item != nullptr && is_vector) {
        return numbers_.items(*item);
    }
    if (const auto* earlier = node.as<StageItem>(); earlier != nullptr && is_vector) {
        return following([&](std::size_t k) {
            return to_.graph.leaf(StageItem{earlier->stage, ItemId(earlier->item.index() + k)});
        });
    }
    if (const auto* value = node.as<CellValue>()) return own_value(*value);
    if (const auto* builtin = node.as<Builtin>()) {
        if (*builtin <= Builtin::z) return {numbers_.place()[static_cast<std::size_t>(*builtin)]};
        if (const auto plane = model_plane_of(*builtin)) return {to_.graph.leaf(*plane)};
    }
    return {to_.graph.add(node)};
}

Parts TissuePass::own_value(CellValue value) {
    const auto plane = [&](ModelPlane of) { return to_.graph.leaf(of); };
    switch (value) {
        case CellValue::off: return {plane(ModelPlane::off)};
        case CellValue::feature: return {plane(ModelPlane::feature)};
        case CellValue::normal:
            return {plane(ModelPlane::nx), plane(ModelPlane::ny), plane(ModelPlane::nz)};
        case CellValue::ex: return numbers_.axis(0);
        case CellValue::ey: return numbers_.axis(1);
        case CellValue::ez: return numbers_.axis(2);
        default: break;
    }
    CHECK(false, "lowering: values of links are read inside of sums over neighbours");
}

Parts TissuePass::value_of_link(CellValue value) {
    switch (value) {
        case CellValue::distance: return {numbers_.distance()};
        case CellValue::direction: return numbers_.direction();
        case CellValue::gap: return {numbers_.gap()};
        case CellValue::overlap: return {numbers_.overlap()};
        case CellValue::contact: return {numbers_.contact()};
        default: break;
    }
    CHECK(false, "lowering: other values are gathered from planes");
}

/// A function of values at the same end.
Parts TissuePass::combined(NodeId id, std::span<const Parts> operands) {
    const Node& node = from_.graph[id];
    switch (node.function) {
        case Function::vector:
            return {operands[0][0], operands[1][0],
                    operands.size() == 3 ? operands[2][0] : numbers_.number(0)};
        case Function::dot: return {numbers_.dot(operands[0], operands[1])};
        case Function::cross: return numbers_.cross(operands[0], operands[1]);
        case Function::length: return {numbers_.length(operands[0])};
        case Function::unit: return numbers_.unit(operands[0]);
        case Function::component: {
            const auto* const axis = from_.graph[node.operands[1]].as<double>();
            CHECK(axis != nullptr, "lowering: which component is known");
            return {operands[0][static_cast<std::size_t>(*axis)]};
        }
        default: break;
    }
    Parts parts{};
    for (std::size_t k = 0; k < part_count(node); ++k) {
        Node part = node;
        if (node.type == ValueType::vector) part.type = ValueType::number;
        for (std::size_t n = 0; n < operands.size(); ++n) {
            const bool is_vector = from_.graph[node.operands[n]].type == ValueType::vector;
            part.operands[n] = operands[n][is_vector ? k : 0];
        }
        parts[k] = to_.graph.add(part, from_.graph.written(id));
    }
    return parts;
}

NodeId TissuePass::reduced(Function function, NodeId is_close, NodeId value, double otherwise) {
    return to_.graph.call(function, {numbers_.choice(is_close, value, numbers_.number(otherwise))});
}

/// A sum, mean, least or greatest over touching or near cells.
Parts TissuePass::over_neighbours(const Node& node) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const NodeId is_close = node.operand_count == 1
                                ? numbers_.is_touching()
                                : numbers_.less(numbers_.distance(), here_[node.operands[1]][0]);
    const Parts& values = there_[node.operands[0]];
    Parts parts{};
    for (std::size_t k = 0; k < part_count(node); ++k) {
        const auto reduced_by = [&](Function function, double otherwise) {
            return reduced(function, is_close, values[k], otherwise);
        };
        switch (node.function) {
            case Function::touching_min:
            case Function::near_min: parts[k] = reduced_by(Function::link_least, infinity); break;
            case Function::touching_max:
            case Function::near_max:
                parts[k] = reduced_by(Function::link_greatest, -infinity);
                break;
            default: parts[k] = reduced_by(Function::link_sum, 0);
        }
        if (node.calls(Function::touching_mean) || node.calls(Function::near_mean)) {
            const NodeId count = reduced(Function::link_sum, is_close, numbers_.number(1), 0);
            parts[k] = numbers_.quotient(parts[k], numbers_.larger(count, numbers_.number(1)));
        }
    }
    return parts;
}

/// sum(contact * (e - own(e)) over touching).
Parts TissuePass::laplacian(const Node& node) {
    const NodeId of = node.operands[0];
    if (is_uniform_[of]) return {numbers_.number(0)};
    const NodeId rise = numbers_.difference(there_[of][0], here_[of][0]);
    return {reduced(Function::link_sum, numbers_.is_touching(),
                    numbers_.times(numbers_.contact(), rise), 0)};
}

}  // namespace

Expressions lay_on_tissue(const Expressions& from, const PassContext& context) {
    return TissuePass(from, context).run();
}

}  // namespace cascade::lowering
