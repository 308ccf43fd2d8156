// Linearises numbers: items, operators, functions, and the kernels of convolutions.
#include "analysis/lineariser.h"
#include "lang/calculus/derivative_rules.h"
#include "lang/program/calls.h"
#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace cascade::analysis {

Lineariser::Lineariser(LinearModel& model)
    : model_(model),
      algebra_(model.algebra),
      zero_(algebra_.number(0)),
      one_(algebra_.number(1)),
      flat_(model.variable_count()),
      axes_(lattice_of(*model.program).has_axis) {}

/// Adds the LinearPart of a node. Fails with a message for the user.
Result<void> Lineariser::add(const Node& node) {
    if (algebra_.size() > most_calculus_nodes) return failure("its rates are too large");
    nodes_.push_back(node);
    parts_.push_back(nothing());
    Part& part = parts_.back();
    if (const auto* number = node.as<double>()) {
        part.value[0] = algebra_.number(*number);
        return {};
    }
    if (const auto* item = node.as<ItemId>()) return add_item(*item, part);
    if (const auto* builtin = node.as<Builtin>()) return add_builtin(*builtin);
    if (const auto* unknown = node.as<Unknown>()) {
        add_unknown(*unknown, part);
        return {};
    }
    if (!node.is<Call>()) {
        return failure("its rates read earlier stages or positions, so no state is flat");
    }
    if (node.type == ValueType::tensor) return add_tensor(node, part);
    if (node.type == ValueType::vector) return add_vector(node, part);
    return add_call(node, part);
}

LinearPart Lineariser::nothing() const {
    Part part;
    part.value.fill(zero_);
    part.slopes = flat_;
    for (auto& faces : part.at_faces) faces.fill(flat_);
    return part;
}

/// A copy of the node in which the operands are replaced by their flat values.
Node Lineariser::of_values(const Node& node) const {
    Node valued = node;
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        valued.operands[n] = part(node, n).value[0];
    }
    return valued;
}

void Lineariser::add(Slopes& sum, const Slopes& slopes, NodeId factor) {
    if (algebra_.is_number(factor, 0)) return;
    for (std::size_t s = 0; s < sum.size(); ++s) {
        for (const auto& [operators, coefficient] : slopes[s]) {
            const auto [known, is_new] = sum[s].try_emplace(operators, zero_);
            known->second = algebra_.sum(known->second, algebra_.product(factor, coefficient));
            if (algebra_.is_number(known->second, 0)) sum[s].erase(known);
        }
    }
}

Slopes Lineariser::through(const Slopes& slopes, WaveOperator each) const {
    Slopes result(slopes.size());
    for (std::size_t s = 0; s < slopes.size(); ++s) {
        for (const auto& [operators, coefficient] : slopes[s]) {
            result[s][followed_by(operators, each)] = coefficient;
        }
    }
    return result;
}

Result<void> Lineariser::add_item(ItemId item, Part& part) {
    const auto found = std::find(model_.species.begin(), model_.species.end(), item);
    if (found != model_.species.end()) {
        part.value[0] = algebra_.leaf(item);
        part.slopes[static_cast<std::size_t>(found - model_.species.begin())][{}] = one_;
        return {};
    }
    const auto value = parameter(item);
    if (!value) return tl::unexpected(value.error());
    part.value[0] = *value;
    return {};
}

Result<NodeId> Lineariser::parameter(ItemId item) {
    const StartValue& start = model_.starts[item];
    if (start.is_unknown) {
        return failure(fmt::format("'{}' comes from a file, so that no state is flat",
                                   model_.system().item_name(item)),
                       fmt::format("give it a number, as in --set {}=…",
                                   model_.system().item_name(item)));
    }
    auto& read = model_.parameters;
    if (std::find(read.begin(), read.end(), item) == read.end()) read.push_back(item);
    return start.value;
}

void Lineariser::add_unknown(Unknown unknown, Part& part) {
    const auto found = std::find(model_.unknowns.begin(), model_.unknowns.end(), unknown);
    part.value[0] = algebra_.leaf(unknown);
    part.slopes[model_.species_count() + static_cast<std::size_t>(found - model_.unknowns.begin())]
               [{}] = one_;
}

Result<void> Lineariser::add_builtin(Builtin builtin) {
    if (builtin == Builtin::t || builtin == Builtin::step) {
        model_.reads_time = true;
        return {};
    }
    if (is_of_model(builtin) && !model_.program->domain.model) return {};
    return failure(fmt::format("its rates read '{}', so that no state is flat",
                               builtin_names[static_cast<std::size_t>(builtin)]));
}

Result<void> Lineariser::add_call(const Node& node, Part& part) {
    const Slopes& first = this->part(node, 0).slopes;
    if (const auto applied = difference_of(node.function)) {
        const auto axis = static_cast<std::size_t>(applied->first);
        const auto other = static_cast<std::size_t>(applied->second);
        const bool is_mixed = applied->difference == Difference::mixed;
        part.slopes = is_mixed ? through(through(first, Difference::central, axis),
                                         Difference::central, other)
                               : through(first, applied->difference, axis);
        return {};
    }
    if (info(node.function).kind == FunctionKind::draw) {
        model_.has_noise = true;
        if (node.function == Function::white) return {};
        part.value[0] = this->part(node, 0).value[0];
        part.slopes = first;
        return {};
    }
    switch (node.function) {
        case Function::grad2: return {};  // A square of a gradient, which is 0 in a flat state.
        case Function::advect: add_advection(node, part); return {};
        case Function::transport: add_transport(node, part); return {};
        case Function::diffuse: add_diffusion(node, part); return {};
        case Function::shifted: add_shift(node, part); return {};
        case Function::div:
            for (std::size_t each = 0; each < 3; ++each) {
                add(part.slopes,
                    through(this->part(node, 0).at_faces[each][each], Difference::across, each),
                    one_);
            }
            return {};
        case Function::convolve: return add_convolution(node, part);
        case Function::solved: add_unknown({*solved_constraint(node)}, part); return {};
        default: break;
    }
    if (info(node.function).is_aggregate) return add_aggregate(node, part);
    return add_function(node, part);
}

Result<void> Lineariser::add_aggregate(const Node& node, Part& part) {
    part.value[0] = this->part(node, 0).value[0];
    NodeId factor = one_;
    if (reduction_of(node.function) == ReductionKind::sum) {
        if (model_.program->domain.model || model_.program->domain.mask) {
            return failure("'sum over domain' in its rates depends on the number of cells");
        }
        factor = algebra_.number(static_cast<double>(model_.program->domain.grid.cell_count()));
        part.value[0] = algebra_.product(factor, part.value[0]);
    }
    add(part.slopes, through(this->part(node, 0).slopes, {Kind::mean}), factor);
    return {};
}

Result<void> Lineariser::add_convolution(const Node& node, Part& part) {
    const Lattice lattice = lattice_of(*model_.program);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (model_.program->domain.mask || (axes_[axis] && !lattice.is_periodic[axis])) {
            return failure(
                "its convolutions end at the border of the domain, so that no state "
                "is flat");
        }
    }
    const auto kernel = kernel_of(node);
    if (!kernel) return tl::unexpected(kernel.error());
    const Part& inner = this->part(node, 0);
    part.value[0] = algebra_.product(algebra_.leaf(model_.kernels[*kernel].sum), inner.value[0]);
    part.slopes =
        through(inner.slopes, {Kind::convolution, {}, static_cast<std::uint8_t>(*kernel)});
    return {};
}

/// The index of the node's kernel in the model.
Result<std::size_t> Lineariser::kernel_of(const Node& node) {
    const std::uint32_t literal = node.as<Call>()->detail;
    auto& kernels = model_.kernels;
    const auto known = std::find_if(kernels.begin(), kernels.end(),
                                    [&](const auto& kernel) { return kernel.literal == literal; });
    if (known != kernels.end()) return static_cast<std::size_t>(known - kernels.begin());
    constexpr std::size_t most = UINT8_MAX;  // The largest index that fits in WaveOperator::axis.
    if (kernels.size() == most) return failure("it has too many convolutions");
    const ConvolutionKernel& written = model_.program->literals->kernel(literal);
    const auto is_file_value = [](const Node& part) {
        return part.is<Call>() && reads_file(part.function);
    };
    if (holds_in(written.weight, is_file_value))
        return failure("the kernel of a convolution comes from a file");
    Flattening flattening(algebra_, FieldSpace::of(*model_.program, model_.system()));
    for (const Formula* formula : {&written.weight, &written.reach}) {
        for (const Node& each : formula->nodes) {
            const auto* item = each.as<ItemId>();
            if (item == nullptr) continue;
            const auto value = parameter(*item);
            if (!value) return tl::unexpected(value.error());
            flattening.set_item(*item, *value);
        }
    }
    KernelFormula kernel;
    kernel.literal = literal;
    kernel.weight = flattening.add(written.weight);
    if (!written.reach.nodes.empty()) kernel.reach = flattening.add(written.reach);
    kernel.sum = ItemId(static_cast<std::uint32_t>(model_.starts.size() + kernels.size()));
    kernels.push_back(kernel);
    return kernels.size() - 1;
}

/// Upwind differences. The carried value is the same in all cells, so a change of the velocity has
/// no effect.
void Lineariser::add_advection(const Node& node, Part& part) {
    const std::size_t velocities = node.operand_count - 1;
    const Slopes& carried = this->part(node, velocities).slopes;
    for (std::size_t axis = 0; axis < velocities; ++axis) {
        const NodeId velocity = this->part(node, axis).value[0];
        add(part.slopes, through(carried, Difference::backward, axis),
            algebra_.maximum(velocity, zero_));
        add(part.slopes, through(carried, Difference::forward, axis),
            algebra_.call(Function::min, {velocity, zero_}));
    }
}

/// Replaces transport by central differences, with which long waves have the same speed. The
/// limited slopes of transport are not linear in the values. Their small damping is ignored.
void Lineariser::add_transport(const Node& node, Part& part) {
    const std::size_t velocities = node.operand_count - 1;
    const Slopes& carried = this->part(node, velocities).slopes;
    for (std::size_t axis = 0; axis < velocities; ++axis) {
        add(part.slopes, through(carried, Difference::central, axis),
            this->part(node, axis).value[0]);
    }
}

void Lineariser::add_diffusion(const Node& node, Part& part) {
    const Slopes& spread = this->part(node, 0).slopes;
    const auto [a11, a12, a22] =
        tensor_entries(algebra_, this->part(node, 1).value[0], this->part(node, 2).value[0],
                       this->part(node, 3).value[0]);
    add(part.slopes, through(spread, Difference::second, 0), a11);
    add(part.slopes, through(spread, Difference::second, 1), a22);
    add(part.slopes, through(through(spread, Difference::central, 0), Difference::central, 1),
        algebra_.product(algebra_.number(2), a12));
}

/// The value in the next cell is the value plus the difference to that cell. A longer shift repeats
/// this step.
void Lineariser::add_shift(const Node& node, Part& part) {
    part.value[0] = this->part(node, 0).value[0];
    part.slopes = this->part(node, 0).slopes;
    const double spacing = model_.program->domain.grid.spacing;
    for (std::size_t axis = 0; axis + 1 < node.operand_count; ++axis) {
        const NodeId number = this->part(node, axis + 1).value[0];
        const auto cells = static_cast<int>(*algebra_[number].as<double>());
        const NodeId step = algebra_.number(cells > 0 ? spacing : -spacing);
        const Difference difference = cells > 0 ? Difference::forward : Difference::backward;
        for (int k = 0; k < std::abs(cells); ++k) {
            add(part.slopes, through(Slopes(part.slopes), difference, axis), step);
        }
    }
}

Result<void> Lineariser::add_function(const Node& node, Part& part) {
    const Node valued = of_values(node);
    const bool is_numeric = !varies_by_cell(node.function) && node.operand_count <= 3 &&
                            info(node.function).kind <= FunctionKind::choice;
    if (!is_numeric) {
        if (varies_by_cell(node.function)) {
            return failure(
                fmt::format("'{}' in its rates varies over the domain, so no state is flat",
                            info(node.function).spelling));
        }
        return without_rule(node);
    }
    part.value[0] = algebra_.call_of(valued);
    for (std::size_t n = 0; n < node.operand_count; ++n) {
        const Slopes& inner = this->part(node, n).slopes;
        if (is_flat(inner)) continue;
        const auto partial = partial_derivative(algebra_, valued, n);
        if (!partial) return without_rule(node);
        add(part.slopes, inner, *partial);
    }
    return {};
}

Result<void> Lineariser::without_rule(const Node& node) const {
    return failure(
        fmt::format("there is no rule for '{}' in its rates", info(node.function).spelling));
}

}  // namespace cascade::analysis
