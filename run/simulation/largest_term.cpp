// A rate is a sum; its summands are evaluated by themselves, as formulas of a picture are.
#include "run/simulation/largest_term.h"

#include "lang/print/print_formula.h"
#include "run/tissue/script_rules.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

namespace {

/// A rate by the name that it has in scripts, and its formula: of a place or a frame the vector of
/// which it is a component.
struct NamedRate {
    std::string_view name;
    const Formula* formula = nullptr;
};

NamedRate rate_of(const System& system, ItemId item) {
    const CellRules& rules = *system.cells;
    if (!rules.has_component(item)) return {system.item_name(item), &system.rates[item]};
    if (item < rules.frame) return {"p", &system.definitions[rules.velocity].formula};
    return {"turn", &system.definitions[rules.spin].formula};
}

/// The summands of the whole formula, in their order, without their signs.
std::vector<Formula> terms_of(const Formula& sum) {
    std::vector<Formula> terms;
    std::vector<NodeId> open{NodeId(sum.nodes.size() - 1)};
    while (!open.empty()) {
        const NodeId root = open.back();
        open.pop_back();
        const Node& node = sum.nodes[root];
        const bool is_sum = node.calls(Function::add) || node.calls(Function::subtract) ||
                            node.calls(Function::negate);
        if (!is_sum) {
            terms.push_back(formula_of(sum.nodes, root));
            continue;
        }
        const auto reads = node.reads();
        open.insert(open.end(), reads.rbegin(), reads.rend());
    }
    return terms;
}

std::optional<std::size_t> find_cell(const Tissue& tissue, std::uint32_t number) {
    for (std::size_t cell = 0; cell < tissue.count(); ++cell) {
        if (tissue.numbers()[cell] == number) return cell;
    }
    return std::nullopt;
}

/// The magnitude of a number or a vector in a cell; infinite where it is not finite.
double size_of(const Formula& term, const StageView& view, std::size_t cell) {
    std::vector<Formula> parts;
    if (term.nodes.back().type == ValueType::vector) {
        for (int axis = 0; axis < 3; ++axis) parts.push_back(component_of(term, axis));
    } else {
        parts.push_back(term);
    }
    std::vector<const Formula*> formulas;
    for (const Formula& part : parts) formulas.push_back(&part);
    double square = 0;
    for (const Field& values : view.evaluate(formulas)) {
        const double value = value_in(values, *view.state().tissue, cell);
        square += value * value;
    }
    return std::isfinite(square) ? std::sqrt(square) : INFINITY;
}

}  // namespace

std::string largest_term(const StageView& view, SpeciesId species, std::uint32_t number) {
    const Tissue& tissue = *view.state().tissue;
    const System& system = view.system();
    const NamedRate rate = rate_of(system, system.species()[species]);
    const std::optional<std::size_t> cell = find_cell(tissue, number);
    const std::vector<Formula> terms = terms_of(*rate.formula);
    if (!cell || terms.size() < 2) return "";
    std::size_t largest = 0;
    double size = 0;
    for (std::size_t k = 0; k < terms.size() && std::isfinite(size); ++k) {
        const double own = size_of(terms[k], view, *cell);
        if (own <= size) continue;
        largest = k;
        size = own;
    }
    if (size == 0) return "";
    const std::string text = print_formula(view.program(), system, terms[largest]);
    return std::isfinite(size)
               ? fmt::format("the largest term of {}' is {}, {:.3g}", rate.name, text, size)
               : fmt::format("a term of {}' is not finite: {}", rate.name, text);
}

}  // namespace cascade
