// The list of passes that turn formulas into the expressions that cells compute.
#include "lang/lower/lower_expressions.h"

#include "core/check.h"
#include "lang/calculus/derivative.h"
#include "lang/program/calls.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace cascade::lowering {

namespace {

bool has_metric(const PassContext& context) { return context.has_metric(); }
bool is_tissue(const PassContext& context) { return context.is_tissue(); }
bool is_on_model(const PassContext& context) { return context.has_links() && !context.is_tissue(); }
bool has_faces(const PassContext& context) { return !context.has_links(); }
bool has_areas(const PassContext& context) { return context.has_metric() || context.has_links(); }
bool has_mask(const PassContext& context) { return context.has_mask(); }
bool has_other_stencil(const PassContext& context) {
    return !context.has_links() && context.program.domain.stencil != StencilKind::cross;
}
bool has_border(const PassContext& context) { return context.has_values_at_border(); }
bool has_fewer_roundings(const PassContext& context) { return context.has_fewer_roundings; }

bool any_node(const Node&) { return true; }
bool is_tensor(const Node& node) { return calls(node, has_tensor); }
bool is_transport(const Node& node) { return node.calls(Function::transport); }
bool is_shift(const Node& node) { return node.calls(Function::shifted); }
bool is_operator(const Node& node) { return calls(node, differentiates); }
bool is_of_whole_planes(const Node& node) { return is_aggregate(node) || is_nonlocal(node); }
bool is_sum_or_quotient(const Node& node) {
    return calls(node, is_sum) || node.calls(Function::divide);
}
bool is_of_cell(const Node& node) { return is_operator(node) || node.is<Builtin>(); }

/// Before the first pass, definitions and rates have been replaced by their expressions
/// (lang/program/flatten.h), and equal expressions have become one node.
constexpr std::array passes{
    // After this pass there are no vectors. Sums over neighbours have become sums of numbers over
    // links, and the operands of `theirs` are in planes.
    PassInfo{"tissue", is_tissue, any_node, lay_on_tissue},
    // Not used on models. After this pass the operands of a tensor are its entries: a11, a12 and
    // a22, or in space a11, a12, a13, a22, a23 and a33. diffuse has two operands: a tensor and the
    // value to differentiate.
    PassInfo{"tensors", has_faces, is_tensor, write_out_tensors},
    // After this pass lap, grad2 and derivatives along the surface are differences along columns
    // and rows, multiplied by planes of the metric. Vectors are fluxes through faces, not
    // directions along the surface.
    PassInfo{"surface", has_metric, is_operator, lay_on_surface},
    // Not used on surfaces. If the stencil is isotropic, lap has become the operator (isotropic)
    // after this pass. If the stencil is of fourth order, derivatives have become combinations of
    // derivatives of second order, some of which read planes of others.
    PassInfo{"stencils", has_other_stencil, is_operator, write_out_stencils},
    // After this pass the only limiters are slopes along an axis. The slopes are in separate
    // planes.
    PassInfo{"limiters", has_faces, is_transport, write_out_limiters},
    // After this pass a value in another cell is read in steps from one cell to an adjacent cell.
    PassInfo{"shifts", has_faces, is_shift, write_out_shifts},
    // After this pass an operand that operators read at neighbours is a node (bordered) if its
    // values beyond the border of the mask differ from its value in the cell beside the border.
    PassInfo{"border", has_border, is_operator, find_beyond_border},
    // After this pass positions and normals are planes of the model. There are no vectors: the
    // operand of div has become a sum of lap(weight, e).
    PassInfo{"links", is_on_model, is_of_cell, spread_over_links},
    // After this pass, if lap has a weight, lap(weight, e), the weight varies by cell.
    PassInfo{"weights", is_on_model, is_operator, take_out_even_weights},
    // After this pass, the areas of cells weight all sums over the domain, and means are quotients
    // of sums.
    PassInfo{"areas", has_areas, is_aggregate, weigh_by_areas},
    // After this pass operands of aggregates and convolutions have no effect outside the mask.
    PassInfo{"mask", has_mask, is_of_whole_planes, leave_out_masked_cells},
    // After this pass a sum that has a product as an operand is rounded once.
    PassInfo{"products", has_fewer_roundings, is_sum_or_quotient, fuse_products},
};

/// Gives the field of each constraint the rules that the stage has for the constraint's definition
/// at the sides.
void add_walls_of_constraints(Expressions& expressions, const PassContext& context) {
    const System& system = context.program.system_of(context.stage);
    const auto& sides = context.program.stages[context.stage].definition_sides;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        const Node& defined = system.definitions[sides[k].definition].formula.nodes.back();
        const auto number = solved_constraint(defined);
        if (!number) continue;
        for (const NodeId id : expressions.graph.nodes().ids()) {
            const Node& node = expressions.graph[id];
            const bool is_field = node.is(Unknown{*number}) || solved_constraint(node) == number;
            if (is_field) expressions.walls.emplace_back(id, k);
        }
    }
}

/// Copies the derivatives of the rates with respect to the cell's species into the graph of the
/// rates. Nodes that both graphs contain are not duplicated. Copied nodes keep the origins of the
/// original formulas, so derivatives draw the same random numbers as the rates.
void add_derivatives(ExpressionGraph& graph, const Program& program, std::uint32_t stage,
                     std::vector<NodeId>& roots) {
    const auto jacobian = local_jacobian(program, stage);
    CHECK(jacobian, "lowering: the solver has been checked");
    std::vector<NodeId> derivatives;
    for (const auto& row : jacobian->rows)
        derivatives.insert(derivatives.end(), row.begin(), row.end());
    const ExpressionGraph& from = jacobian->algebra;
    const auto needed = needed_by(from, derivatives);
    IdVector<NodeId, NodeId> images(needed.size());
    for (const NodeId id : needed.ids()) {
        if (!needed[id]) continue;
        Node node = from[id];
        for (NodeId& operand : node.reads()) operand = images[operand];
        images[id] = graph.add(node, from.written(id));
    }
    for (const NodeId id : derivatives) roots.push_back(images[id]);
}

/// Adds the roots to the expressions. `flattening` refers to the graph in `expressions`, so the
/// expressions are moved last.
Expressions with_roots(Expressions&& expressions, const Flattening& flattening,
                       std::vector<NodeId> roots) {
    expressions.roots = std::move(roots);
    expressions.origins = flattening.origins();
    expressions.names = flattening.names();
    return std::move(expressions);
}

}  // namespace

Expressions flat_start(const Program& program, std::uint32_t stage, std::span<const ItemId> items) {
    Expressions flat;
    const System& system = program.system_of(stage);
    Flattening flattening(flat.graph, FieldSpace::of(program, system));
    std::vector<NodeId> roots;
    for (const ItemId item : items) {
        const std::string name(system.draw_name(item));
        roots.push_back(flattening.add(program.stages[stage].items[item], {name, false}));
        flattening.set_item(item, roots.back());
    }
    return with_roots(std::move(flat), flattening, std::move(roots));
}

Expressions flat_step(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    Expressions flat;
    Flattening flattening(flat.graph, FieldSpace::of(program, system));
    std::vector<NodeId> roots;
    flattening.add_rates(system);
    for (const ItemId item : system.rate_order) roots.push_back(flattening.rate(item));
    for (const Invariant& each : system.invariants) roots.push_back(flattening.add(each.bound));
    const auto& sides = program.stages[stage].definition_sides;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        flat.walls.emplace_back(flattening.definition(sides[k].definition), k);
    }
    add_walls_of_constraints(flat, {program, stage});
    if (is_locally_implicit(program.stages[stage].time.solver)) {
        add_derivatives(flat.graph, program, stage, roots);
    }
    return with_roots(std::move(flat), flattening, std::move(roots));
}

Expressions flat_formulas(std::span<const Formula* const> formulas, const PassContext& context,
                          const Noise& noise) {
    Expressions flat;
    const System& system = context.program.system_of(context.stage);
    Flattening flattening(flat.graph, FieldSpace::of(context.program, system));
    std::vector<NodeId> roots;
    for (const Formula* formula : formulas) roots.push_back(flattening.add(*formula, noise));
    add_walls_of_constraints(flat, context);
    return with_roots(std::move(flat), flattening, std::move(roots));
}

std::span<const PassInfo> graph_passes() { return passes; }

Expressions lower_expressions(Expressions flat, const PassContext& context,
                              const PassWatch& watch) {
    if (watch) watch("flatten", flat);
    for (const PassInfo& pass : passes) {
        if (!pass.is_about(context) || !std::ranges::any_of(flat.graph.nodes(), pass.changes)) {
            continue;
        }
        flat = pass.run(flat, context);
        if (watch) watch(pass.name, flat);
    }
    return flat;
}

void watch_lowering(const Program& program, const LoweringWatch& watch) {
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        const PassContext usual{program, k}, of_steps = context_of_steps(program, k);
        const std::array view{&program.stages[k].show};
        const auto lower = [&](std::string_view what, const PassContext& context,
                               Expressions flat) {
            lower_expressions(std::move(flat), context,
                              [&](std::string_view pass, const Expressions& after) {
                                  watch(context, what, pass, after);
                              });
        };
        lower("starting values", context_of_start(program, k),
              flat_start(program, k, program.stages[k].order));
        lower("one step", of_steps, flat_step(program, k));
        if (!view[0]->nodes.empty()) lower("picture", usual, flat_formulas(view, usual));
    }
}

}  // namespace cascade::lowering
