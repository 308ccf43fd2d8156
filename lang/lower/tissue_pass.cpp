// Rewrites formulas of crawling cells: vectors become three numbers each, and sums over neighbours
// become sums over links.
//
// Inside a sum over neighbours, names mean the neighbour's values. So a node has up to two images:
// its value in the cell (`here`), and its value at the other end of a link (`there`). A node that
// reads no value of the link depends only on the neighbour. Its image `there` is either read from a
// plane that an earlier pass writes (`theirs`), or, if that is cheap, computed for each link from
// the planes that the node reads. All sums have the same form: link_sum of a number that is the
// value if the cells touch, and 0 otherwise. All sums share the nodes of distances and of the
// conditions for touching, and kernels compute all sums in one loop over links.
#include "lang/lower/graph_passes.h"

#include "core/check.h"
#include "lang/lower/pass_planner.h"
#include "lang/lower/tissue_numbers.h"
#include "lang/program/models.h"
#include "lang/program/vector_functions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace cascade::lowering {

namespace {

/// A number (in x), or the three components of a vector.
using Parts = TermVector;

/// The approximate number of neighbours of a cell.
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
        bool is_of_link = false;  ///< Whether the node reads a value of the link, or own(e).
        bool stays = false;       ///< Whether the node cannot be computed for a neighbour.
        int operations = 0;       ///< The number of operations that compute the node from planes.
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

/// Whether the neighbour's value of a node is read from a plane. If not, it is computed for each
/// link. The node must vary and must not depend on the link. Axes of frames are read from planes:
/// combing with six neighbours takes 22 ns per cell with planes of ez, including the pass that
/// writes them, and 26 ns if the quaternions are read at the neighbours instead.
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
    const auto leaf = [&](const NodeKind& kind) { return numbers_.leaf(kind); };
    const bool is_vector = node.type == ValueType::vector;
    if (const auto* item = node.as<ItemId>(); item != nullptr && is_vector) {
        return numbers_.items(*item);
    }
    if (const auto* earlier = node.as<StageItem>(); earlier != nullptr && is_vector) {
        const auto item = [&](std::size_t k) {
            return leaf(StageItem{earlier->stage, ItemId(earlier->item.index() + k)});
        };
        return {item(0), item(1), item(2)};
    }
    if (const auto* value = node.as<CellValue>()) return own_value(*value);
    if (const auto* builtin = node.as<Builtin>()) {
        if (*builtin <= Builtin::z) return {numbers_.place()[static_cast<std::size_t>(*builtin)]};
        if (const auto plane = model_plane_of(*builtin)) return {leaf(*plane)};
    }
    return {numbers_.term(to_.graph.add(node))};
}

Parts TissuePass::own_value(CellValue value) {
    const auto leaf = [&](ModelPlane plane) { return numbers_.leaf(plane); };
    switch (value) {
        case CellValue::off: return {leaf(ModelPlane::off)};
        case CellValue::feature: return {leaf(ModelPlane::feature)};
        case CellValue::normal:
            return {leaf(ModelPlane::nx), leaf(ModelPlane::ny), leaf(ModelPlane::nz)};
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

/// The result of a function whose operands are all values at the same end of the link.
Parts TissuePass::combined(NodeId id, std::span<const Parts> operands) {
    const Node& node = from_.graph[id];
    return of_components<Term>(from_.graph, node, operands, [&](const auto& numbers) {
        Node part = node;
        if (node.type == ValueType::vector) part.type = ValueType::number;
        std::ranges::copy(numbers, part.operands.begin());
        return numbers_.term(to_.graph.add(part, from_.graph.written(id)));
    });
}

/// A sum, mean, minimum or maximum over the cells that are touching or near.
Parts TissuePass::over_neighbours(const Node& node) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Term is_close = node.operand_count == 1 ? numbers_.is_touching()
                                                  : numbers_.distance() < here_[node.operands[1]].x;
    const auto where_close = [&](Term value, double otherwise) {
        return if_(is_close, value, numbers_.leaf(otherwise));
    };
    const Parts& values = there_[node.operands[0]];
    const auto kind = *reduction_of(node.function);
    Parts parts;
    for (std::size_t k = 0; k < part_count(node); ++k) {
        if (kind == ReductionKind::least) {
            parts[k] = link_least(where_close(values[k], infinity));
        } else if (kind == ReductionKind::largest) {
            parts[k] = link_greatest(where_close(values[k], -infinity));
        } else {
            parts[k] = link_sum(where_close(values[k], 0));
        }
        if (kind == ReductionKind::mean) {
            const Term one = numbers_.leaf(1.0), count = link_sum(where_close(one, 0));
            parts[k] = parts[k] / max(count, one);
        }
    }
    return parts;
}

/// Rewrites lap(e) as sum(contact * (e - own(e)) over touching).
Parts TissuePass::laplacian(const Node& node) {
    const NodeId of = node.operands[0];
    if (is_uniform_[of]) return {numbers_.leaf(0.0)};
    const Term rise = there_[of].x - here_[of].x, flow = numbers_.contact() * rise;
    const Term is_touching = numbers_.is_touching();
    return {link_sum(if_(is_touching, flow, numbers_.leaf(0.0)))};
}

}  // namespace

Expressions lay_on_tissue(const Expressions& from, const PassContext& context) {
    return TissuePass(from, context).run();
}

}  // namespace cascade::lowering
