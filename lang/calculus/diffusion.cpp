// Forwards through the parts of the rates: each as a sum of operators applied to the species.
#include "lang/calculus/diffusion.h"

#include "lang/calculus/derivative_rules.h"
#include "lang/calculus/flat_rates.h"
#include "lang/program/nodes_of_rates.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cascade {

namespace {

/// How a part changes with the species: itself, then the operators of DiffusionTerms.
struct Operators {
    PartId own = 0;
    DiffusionTerms<PartId> terms{};
};

class Linearisation {
public:
    Linearisation(FlatRates& rates, std::uint32_t species)
        : rates_(rates), builder_(rates.builder()), species_(species), zero_(builder_.number(0)) {}

    /// The operators of all parts; fewer where they become too many.
    std::vector<Operators> run() && {
        found_.reserve(rates_.part_count());
        for (PartId id = 0; id < rates_.part_count() && builder_.size() < most_calculus_parts;
             ++id) {
            found_.push_back(operators_of(id));
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
        const auto is_zero = [&](PartId id) { return builder_.is_number(id, 0); };
        return is_zero(operators.own) &&
               std::all_of(operators.terms.begin(), operators.terms.end(), is_zero);
    }

    Operators operators_of(PartId id) {
        const Node node = builder_[id];
        Operators result = nothing();
        if (node.kind == NodeKind::own && node.index == species_) result.own = builder_.number(1);
        if (node.kind != NodeKind::call) return result;
        const Derivative derivative = derivative_of(node.function);
        if (derivative.order == 2 && !derivative.is_mixed()) {
            return along_axis(found_[node.operands[0]], derivative.first);
        }
        switch (node.function) {
            case Function::lap:
            case Function::div: return laplacian(found_[node.operands[0]]);
            case Function::grad: return found_[node.operands[0]];
            case Function::diffuse: return directed(node);
            default: break;
        }
        const bool is_vector = node.type == ValueType::vector;
        for (std::size_t n = 0; n < operand_count(node); ++n) {
            const PartId operand = node.operands[n];
            // The change of a factor times a gradient is a drift.
            if (is_vector && builder_[operand].type != ValueType::vector) continue;
            if (is_nothing(found_[operand])) continue;
            const auto partial = partial_derivative(builder_, node, n);
            if (!partial) continue;
            add(result, *partial, found_[operand]);
        }
        return result;
    }

    void add(Operators& sum, PartId factor, const Operators& operators) {
        if (builder_[factor].type != ValueType::number) return;
        const auto add_one = [&](PartId& to, PartId term) {
            to = builder_.add(to, builder_.multiply(factor, term));
        };
        add_one(sum.own, operators.own);
        for (std::size_t k = 0; k < diffusion_terms; ++k) add_one(sum.terms[k], operators.terms[k]);
    }

    /// Higher powers than there are, and lap of one axis' operator, are left out.
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

    /// a11 dxx + a22 dyy + 2 a12 dxy, of which no wave is damped more than by (a11 + |a12|) dxx +
    /// (a22 + |a12|) dyy: the symbol of dxy is no larger than the mean of those of dxx and dyy.
    Operators directed(const Node& node) {
        Operators result = nothing();
        const PartId own = found_[node.operands[0]].own;
        if (builder_.is_number(own, 0)) return result;
        const auto square = [&](PartId a) { return builder_.multiply(a, a); };
        const PartId along = square(node.operands[1]), across = square(node.operands[2]);
        const PartId cosine = builder_.call(Function::cos, {node.operands[3]});
        const PartId sine = builder_.call(Function::sin, {node.operands[3]});
        const auto mixed = [&](PartId a, PartId b) {
            return builder_.add(builder_.multiply(a, square(cosine)),
                                builder_.multiply(b, square(sine)));
        };
        const PartId a12 = builder_.absolute(
            builder_.multiply(builder_.subtract(along, across), builder_.multiply(sine, cosine)));
        const auto factor = [&](PartId a) { return builder_.multiply(builder_.add(a, a12), own); };
        result.terms[laplacian_powers] = factor(mixed(along, across));
        result.terms[laplacian_powers + 1] = factor(mixed(across, along));
        return result;
    }

    FlatRates& rates_;
    FormulaBuilder& builder_;
    std::uint32_t species_;
    PartId zero_;
    std::vector<Operators> found_;
};

}  // namespace

std::vector<SpeciesDiffusion> diffusion_of(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    std::vector<SpeciesDiffusion> result;
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (!system.is_species(item)) continue;
        SpeciesDiffusion& of_species = result.emplace_back();
        FlatRates rates(system);
        const std::vector<Operators> found = Linearisation(rates, item).run();
        if (rates.rate(item) >= found.size()) continue;
        for (std::size_t k = 0; k < diffusion_terms; ++k) {
            FormulaBuilder& builder = rates.builder();
            PartId factor = found[rates.rate(item)].terms[k];
            if (builder.is_number(factor, 0)) continue;
            const bool is_even_power = k < laplacian_powers && k % 2 == 1;
            if (is_even_power) factor = builder.negate(factor);
            Formula formula = builder.formula(factor);
            if (!holds_in(formula, is_draw)) of_species[k] = std::move(formula);
        }
    }
    return result;
}

bool changes_in_time(const Program& program, std::uint32_t stage, const Formula& formula) {
    const System& system = program.system_of(stage);
    return holds_in(formula, [&](const Node& node) {
        if (node.kind == NodeKind::own) return system.is_species(node.index);
        if (node.kind != NodeKind::builtin) return false;
        const auto builtin = static_cast<Builtin>(node.index);
        return builtin == Builtin::t || builtin == Builtin::step;
    });
}

}  // namespace cascade
