// Goes through the subexpressions of the rates, operands first. Writes each subexpression as a sum
// of operators applied to the species.
#include "lang/calculus/diffusion.h"

#include "lang/calculus/derivative_rules.h"
#include "lang/calculus/algebra.h"
#include "lang/program/nodes_of_rates.h"
#include "lang/program/stencils.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace cascade {

namespace {

/// How a subexpression of a rate depends on the species: directly (`own`), or through the operators
/// of DiffusionTerms.
struct Operators {
    Term own;
    DiffusionTerms<Term> terms{};
};

/// Whether a node has the same value in all cells. Returns false for an aggregate whose operand
/// differs by cell.
bool is_even(const ExpressionGraph& graph, NodeId root, const Program& program,
             std::uint32_t stage) {
    return std::ranges::none_of(formula_of(graph.nodes(), root).nodes, [&](const Node& node) {
        return differs_by_cell(node, false, program, stage);
    });
}

class Linearisation {
public:
    Linearisation(FlatRates& rates, ItemId species, const Program& program, std::uint32_t stage,
                  std::optional<Side> face)
        : rates_(rates),
          algebra_(rates.algebra),
          species_(species),
          program_(program),
          stage_(stage),
          face_(face),
          zero_{&algebra_, algebra_.number(0)} {}

    /// Finds the operators of all subexpressions. Stops early if there are too many nodes.
    IdVector<NodeId, Operators> run() && {
        found_.reserve(rates_.count);
        while (found_.size() < rates_.count && algebra_.size() < most_calculus_nodes) {
            found_.push_back(operators_of(found_.next()));
        }
        return std::move(found_);
    }

private:
    Operators nothing() const {
        Operators none;
        none.own = zero_;
        none.terms.fill(zero_);
        return none;
    }
    bool is_nothing(const Operators& operators) const {
        const auto is_zero = [&](NodeId id) { return algebra_.is_number(id, 0); };
        return is_zero(operators.own) &&
               std::all_of(operators.terms.begin(), operators.terms.end(), is_zero);
    }

    Operators operators_of(NodeId id) {
        const Node node = algebra_[id];
        Operators result = nothing();
        if (node.is(species_)) result.own = zero_.number(1);
        if (!node.is<Call>()) return result;
        const Operators& first = found_[node.operands[0]];
        const auto applied = difference_of(node.function);
        if (applied && applied->difference == Difference::second) {
            return along_axis(first, applied->first);
        }
        const bool is_lap = applied && applied->difference == Difference::laplacian;
        if (is_lap || node.function == Function::div) return laplacian(first);
        if (node.function == Function::grad) return first;
        if (node.function == Function::diffuse) return directed(node);
        const bool is_vector = node.type == ValueType::vector;
        for (std::size_t n = 0; n < node.operand_count; ++n) {
            const NodeId operand = node.operands[n];
            // If the factor of a gradient depends on the species, this dependence is drift and not
            // diffusion.
            if (is_vector && algebra_[operand].type != ValueType::vector) continue;
            if (is_nothing(found_[operand])) continue;
            const auto partial = partial_derivative(algebra_, node, n);
            if (!partial) continue;
            add(result, {&algebra_, *partial}, found_[operand]);
        }
        return result;
    }

    void add(Operators& sum, Term factor, const Operators& operators) {
        if (factor.type() != ValueType::number) return;
        sum.own = sum.own + factor * operators.own;
        const Term outside{&algebra_, at_face(factor)};
        for (std::size_t k = 0; k < diffusion_terms; ++k) {
            sum.terms[k] = sum.terms[k] + outside * operators.terms[k];
        }
    }

    /// The value of `coordinate` at the face minus its value at the centre of the cell. 0 unless
    /// `coordinate` is the position along the axis that crosses the face. Also 0 on surfaces, where
    /// positions do not follow the rows and columns.
    double way_to_face(Builtin coordinate) const {
        const DomainSettings& domain = program_.domain;
        if (!face_ || *face_ == Side::border || domain.surface || domain.model) return 0;
        const auto side = static_cast<std::size_t>(*face_);
        const Grid& grid = domain.grid;
        const std::int64_t cells = side < 2 ? grid.width : side < 4 ? grid.height : grid.depth;
        constexpr Builtin along[] = {Builtin::x, Builtin::y, Builtin::z};
        constexpr Builtin in_shares[] = {Builtin::sx, Builtin::sy, Builtin::sz};
        const double way = side % 2 == 0 ? -0.5 : 0.5;
        if (coordinate == along[side / 2]) return way / static_cast<double>(grid.longest_side());
        if (coordinate == in_shares[side / 2]) return way / static_cast<double>(cells);
        return 0;
    }

    /// The factor `root`, with positions at the face in place of positions at the centre of the
    /// cell.
    NodeId at_face(NodeId root) {
        if (!face_) return root;
        const IdVector<NodeId, bool> needed = needed_by(algebra_, {&root, 1});
        IdVector<NodeId, NodeId> moved;
        for (const NodeId id : ids_below<NodeId>(needed.size())) {
            moved.push_back(id);
            if (!needed[id]) continue;
            Node node = algebra_[id];
            if (const auto* coordinate = node.as<Builtin>()) {
                const double way = way_to_face(*coordinate);
                if (way != 0) moved[id] = algebra_.sum(id, algebra_.number(way));
            }
            bool changes = false;
            for (std::size_t n = 0; n < node.operand_count; ++n) {
                changes |= moved[node.operands[n]] != node.operands[n];
                node.operands[n] = moved[node.operands[n]];
            }
            const bool is_plain = node.type == ValueType::number && node.is(NodeKind(Call()));
            if (changes && is_plain && node.operand_count <= 3) moved[id] = algebra_.call_of(node);
        }
        return moved[root];
    }

    /// Applies lap. Drops powers of lap higher than the highest in DiffusionTerms. Drops lap of an
    /// operator along a single axis.
    Operators laplacian(const Operators& of) const {
        Operators result = nothing();
        result.terms[0] = of.own;
        for (std::size_t k = 1; k < laplacian_powers; ++k) result.terms[k] = of.terms[k - 1];
        return result;
    }

    Operators along_axis(const Operators& of, int axis) const {
        Operators result = nothing();
        result.terms[laplacian_powers + static_cast<std::size_t>(axis)] = of.own;
        return result;
    }

    /// The symbol of dxy is at most the mean of the symbols of dxx and dyy. So a11 dxx + a22 dyy +
    /// 2 a12 dxy damps no wave more than (a11 + |a12|) dxx + (a22 + |a12|) dyy. Between periodic
    /// sides the symbol of dxy is known for each wave. Between other sides dxy couples different
    /// waves.
    Operators directed(const Node& node) {
        Operators result = nothing();
        const Term own{&algebra_, found_[node.operands[0]].own};
        if (own.is(0)) return result;
        const auto [a11, mixed, a22] =
            tensor_entries(algebra_, node.operands[1], node.operands[2], node.operands[3]);
        const Boundaries& sides = program_.domain.grid.boundary;
        const bool is_periodic = sides.x == Boundary::periodic && sides.y == Boundary::periodic;
        if (is_periodic && std::ranges::all_of(std::array{a11, mixed, a22, own}, [&](NodeId id) {
                return is_even(algebra_, id, program_, stage_);
            })) {
            const auto factor = [&](Term a) { return a * own; };
            result.terms[laplacian_powers] = factor(a11);
            result.terms[laplacian_powers + 1] = factor(a22);
            result.terms[mixed_term] = zero_.number(2) * factor(mixed);
            return result;
        }
        const Term a12 = abs(mixed);
        const auto factor = [&](Term a) { return (a + a12) * own; };
        result.terms[laplacian_powers] = factor(a11);
        result.terms[laplacian_powers + 1] = factor(a22);
        return result;
    }

    FlatRates& rates_;
    Algebra& algebra_;
    ItemId species_;
    const Program& program_;
    std::uint32_t stage_;
    std::optional<Side> face_;
    Term zero_;
    IdVector<NodeId, Operators> found_;
};

}  // namespace

IdVector<SpeciesId, SpeciesDiffusion> diffusion_of(const Program& program, std::uint32_t stage,
                                                   std::optional<Side> face) {
    const System& system = program.system_of(stage);
    IdVector<SpeciesId, SpeciesDiffusion> result;
    for (const ItemId item : system.species()) {
        SpeciesDiffusion& of_species = result.emplace_back();
        FlatRates rates(system, FieldSpace::of(program, system));
        const IdVector<NodeId, Operators> found =
            Linearisation(rates, item, program, stage, face).run();
        if (rates.rate(item) >= found.next()) continue;
        for (std::size_t k = 0; k < diffusion_terms; ++k) {
            Algebra& algebra = rates.algebra;
            Term factor = found[rates.rate(item)].terms[k];
            if (algebra.is_number(factor, 0)) continue;
            const bool is_even_power = k < laplacian_powers && k % 2 == 1;
            if (is_even_power) factor = -factor;
            Formula formula = algebra.formula(factor);
            if (!holds_in(formula, is_draw)) of_species[k] = std::move(formula);
        }
        const bool diffuses = std::ranges::any_of(of_species, [](const Formula& factor) {
            return !factor.nodes.empty();
        });
        const Term own = found[rates.rate(item)].own;
        if (!diffuses || rates.algebra.is_number(own, 0) ||
            !is_even(rates.algebra, own, program, stage)) {
            continue;
        }
        Formula decay = rates.algebra.formula(-own);
        if (!holds_in(decay, is_draw)) of_species[decay_term] = std::move(decay);
    }
    return result;
}

bool changes_in_time(const Program& program, std::uint32_t stage, const Formula& formula) {
    const System& system = program.system_of(stage);
    return holds_in(formula,
                    [&](const Node& node) { return is_species(system, node) || is_moment(node); });
}

}  // namespace cascade
