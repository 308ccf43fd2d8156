// Multiplies every call whose value depends on lengths by a power of the factor.
#include "lang/program/scaled_lengths.h"

#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// The n for which the value of a function is proportional to length^-n.
double power_of_length(Function function, const DomainSettings& domain) {
    switch (function) {
        case Function::domain_sum:
            // Only on models is the sum an integral.
            return domain.model ? -2 : 0;
        case Function::white:
            // White noise is divided by the square root of a cell's content.
            return axes_of(domain) / 2.0;
        case Function::convolve:
            // A convolution is an integral over lengths, areas or volumes.
            return -axes_of(domain);
        default: return info(function).lengths;
    }
}

NodeId append(Formula& formula, Node node) {
    const NodeId id = formula.nodes.next();
    formula.nodes.push_back(node);
    return id;
}

/// The product of a node and a number.
NodeId scaled(Formula& formula, NodeId id, double factor) {
    const Node& value = formula.nodes[id];
    Node product{Call{}, value.span, value.type, Function::multiply, 2, {}};
    const NodeId number = append(formula, Node{factor, product.span});
    product.operands[0] = id;
    product.operands[1] = number;
    return append(formula, product);
}

/// The kernel for scaled lengths. At a distance that is `factor` times as long, its weight is the
/// weight that the given kernel has at the original distance.
ConvolutionKernel with_lengths(const ConvolutionKernel& kernel, double factor) {
    ConvolutionKernel result;
    IdVector<NodeId, NodeId> place;
    for (Node node : kernel.weight.nodes) {
        for (NodeId& operand : node.reads()) operand = place[operand];
        NodeId id = append(result.weight, node);
        if (node.is(CellValue::distance)) id = scaled(result.weight, id, 1 / factor);
        place.push_back(id);
    }
    result.reach = kernel.reach;
    if (!result.reach.nodes.empty()) {
        scaled(result.reach, NodeId(result.reach.nodes.size() - 1), factor);
    }
    return result;
}

Formula with_lengths(const Formula& formula, double factor, const DomainSettings& domain,
                     Literals& literals) {
    Formula result;
    IdVector<NodeId, NodeId> place;
    for (Node node : formula.nodes) {
        for (NodeId& operand : node.reads()) operand = place[operand];
        if (node.calls(Function::convolve)) {
            node.kind =
                Call{literals.add(with_lengths(literals.kernel(node.as<Call>()->detail), factor))};
        }
        const double power = node.is<Call>() ? power_of_length(node.function, domain) : 0;
        NodeId id = append(result, node);
        if (power != 0) id = scaled(result, id, std::pow(factor, power));
        place.push_back(id);
    }
    return result;
}

/// Scales rules at sides. With larger lengths, slopes become smaller and fluxes larger.
void scale_sides(SideSettings& sides, const DomainSettings& domain, double factor) {
    for (std::size_t side = 0; side < wall_count; ++side) {
        SideSetting& setting = sides[side];
        const auto& of_domain = domain.sides[side];
        if (of_domain && of_domain->span == setting.span) continue;
        if (setting.kind != SideKind::slope && setting.kind != SideKind::flux) continue;
        const double by = setting.kind == SideKind::slope ? 1 / factor : factor;
        scaled(setting.value, NodeId(setting.value.nodes.size() - 1), by);
    }
}

}  // namespace

int axes_of(const DomainSettings& domain) {
    if (domain.model) return 2;
    const Grid& grid = domain.grid;
    return int{grid.width > 1} + int{grid.height > 1} + int{grid.depth > 1};
}

Program with_lengths(const Program& program, std::uint32_t stage, double factor) {
    Program result = program;
    Stage& target = result.stages[stage];
    if (target.size) target.size->factor = factor;
    if (factor == 1) return result;
    System system = program.system_of(stage);
    for (Definition& each : system.definitions)
        each.formula = with_lengths(each.formula, factor, program.domain, *result.literals);
    for (Formula& rate : system.rates)
        rate = with_lengths(rate, factor, program.domain, *result.literals);
    for (auto& sides : target.sides) scale_sides(sides, program.domain, factor);
    for (DefinitionSides& each : target.definition_sides)
        scale_sides(each.sides, program.domain, factor);
    target.system = result.systems.next();
    result.systems.push_back(std::move(system));
    return result;
}

}  // namespace cascade
