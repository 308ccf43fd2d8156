// Programs on models: the grid of a model's cells, and checks for functions that have no meaning on
// the domain.
#pragma once

#include "core/diagnostics.h"
#include "lang/program/program.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// The largest number of cells of a model, 2^28. The limit exists because elements of a plane are
/// indexed by words of 32 bits.
inline constexpr double most_model_cells = 268435456;

/// A grid whose rows hold `cells` cells (Grid::linked).
Grid rows_of_cells(std::int64_t cells);

/// Facts about a model's cells, known after the cells have been made. Until then,
/// DomainSettings::grid has rows for as many cells as the script sets.
struct ModelFacts {
    Grid grid;  ///< The rows that hold the cells.
    /// The sum of the weights of a cell's links, for the cell with the largest sum.
    double largest_weight = 0;
};

/// The shape that `word` names in scripts, such as sphere. nullopt if there is no such shape.
std::optional<ModelShape> shape_named(std::string_view word);
/// The name of a shape in scripts; empty for a file.
std::string_view word_of(ModelShape shape);

/// The plane of a model that contains a built-in value. nullopt for t and step.
std::optional<ModelPlane> model_plane_of(Builtin builtin);

/// Reports every function in a formula (of fields or of cells that crawl) that has no meaning on
/// the domain. Examples are dxx on a model, and distances along the surface on a plane. Returns
/// true if there is no such function.
bool has_meaning_on_domain(const Program& program, const Formula& formula, const System& system,
                           Diagnostics& diagnostics);
/// Checks all formulas that the program's stages compute.
bool has_meaning_on_domain(const Program& program, Diagnostics& diagnostics);

/// All formulas that the stages of a program compute. The formulas of a system are listed only
/// once.
std::vector<const Formula*> formulas_of(const Program& program);

}  // namespace cascade
