// Operators and values of other cells in formulas of VisualPDE, also in domains that change.
//
// If a mask reads t or a species, the script has a definition that is 1 inside the mask. Cells
// outside have the value that the mask's boundary condition gives, and operators read this value,
// as they do in VisualPDE. If the border is closed, so that nothing flows through, operators leave
// out the cells outside.
#include "import/visual_pde.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::importing {

/// Whether nothing flows through the border of a mask that changes. For other conditions, VisualPDE
/// reads the values outside of the mask.
bool VisualPdeNames::is_closed(const std::string& species) const {
    const auto found = std::find(species_.begin(), species_.end(), species);
    if (inside_.empty() || found == species_.end()) return false;
    const std::string kind = kind_of_sides(static_cast<std::size_t>(found - species_.begin()));
    return kind == "neumann" || kind == "robin";
}

/// An operator applied to a species. If the mask changes and its border is closed, a neighbour
/// outside counts with the cell's own value: an operator L that is 0 for constants becomes L(inside
/// u) - u L(inside).
Expression VisualPdeNames::operate(const std::string& function, const std::string& species) {
    differentiate(species);
    const Expression u = name(species);
    if (!is_closed(species)) return call(function, {u});
    const std::string own = function + "_inside";
    add_function(
        fmt::format("fn {0}(u, inside) = {1}(inside * u) - u * {1}(inside)", own, function));
    return call(own, {u, name(inside_)});
}

/// div(factor * grad(species)) in a domain that changes, where nothing crosses the border.
std::optional<Expression> VisualPdeNames::flow(Expression factor, const std::string& species) {
    if (factor.text == "symmetric") return std::nullopt;
    operate("lap", species);
    add_function(
        "fn flow_inside(k, u, inside) = (k * lap_inside(u, inside) + lap_inside(u, inside * k)) / "
        "2");
    return call("flow_inside", {std::move(factor), name(species), name(inside_)});
}

/// The value in the cell `right` columns to the right and `up` rows upwards.
Expression VisualPdeNames::shifted(const std::string& species, int right, int up) {
    differentiate(species);
    const auto in_cell = [&](const std::string& value) {
        std::vector<Expression> arguments{name(value), number(right)};
        if (!is_line_) arguments.push_back(number(up == 0 ? 0 : -up));
        return call("shifted", std::move(arguments));
    };
    if (!is_closed(species)) return in_cell(species);
    return call("if", {in_cell(inside_), in_cell(species), name(species)});
}

}  // namespace cascade::importing
