// Programs on models: their domain, and the functions that have no meaning there.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// 2^28, since elements of a plane are indexed by 32-bit words.
inline constexpr double most_model_cells = 268435456;

/// A grid of rows for this number of cells: see Grid::linked.
Grid rows_of_cells(std::int64_t cells);

/// Facts about a model's cells once they are made. DomainSettings::grid has rows for the number of
/// cells that the script asks for.
struct ModelFacts {
    Grid grid;                  ///< The rows in which they lie.
    double largest_weight = 0;  ///< The largest sum of the weights of one cell's links.
};

/// The shape with this name, such as sphere; nothing for other words.
std::optional<ModelShape> shape_named(std::string_view word);
/// The name of a shape in scripts; empty for a file.
std::string_view word_of(ModelShape shape);

/// The plane that holds a built-in value on a model; nothing for t and step.
std::optional<ModelPlane> model_plane_of(Builtin builtin);

/// Adds an error for every function of a formula, of fields or of cells that crawl, that has no
/// meaning on the domain, such as second derivatives by name on a model or distances along the
/// surface on a plane. Returns true if there is none.
bool has_meaning_on_domain(const Program& program, const Formula& formula, const System& system,
                           Diagnostics& diagnostics);
/// The same for all formulas that the stages of the program compute.
bool has_meaning_on_domain(const Program& program, Diagnostics& diagnostics);

/// Every formula that the stages of a program compute; those of a system only once.
std::vector<const Formula*> formulas_of(const Program& program);

}  // namespace cascade
