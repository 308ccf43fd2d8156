// Programs on models: what their domain is, and what of a program has no meaning there.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// The rows in which so many cells lie, as a grid: see Grid::linked.
Grid rows_of_cells(std::int64_t cells);

/// What is known of the cells of a model when they are made. DomainSettings::grid are the rows of
/// as many as the script asks for.
struct ModelFacts {
    Grid grid;                  ///< The rows in which they lie.
    double largest_weight = 0;  ///< The largest sum of the weights of a cell's links.
};

/// The shape of a surface that has a name, such as sphere; nothing for other words.
std::optional<ModelShape> shape_named(std::string_view word);
/// The word for a shape in scripts; empty for a file.
std::string_view word_of(ModelShape shape);

/// The plane that has a built-in value on a model; nothing of t and step.
std::optional<ModelPlane> model_plane_of(Builtin builtin);

/// Adds an error for every function of a formula that has no meaning on the domain, such as second
/// derivatives by name on a model and distances along it on a plane; true where there is none.
bool has_meaning_on_domain(const Program& program, const Formula& formula,
                           Diagnostics& diagnostics);

/// Every formula that the stages of a program compute, those of their systems once.
std::vector<const Formula*> formulas_of(const Program& program);

}  // namespace cascade
