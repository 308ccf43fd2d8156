// Checks the lengths of the domain, which may be formulas of time (internal to the checker).
#pragma once

#include "core/diagnostics.h"
#include "lang/check/names/check_names.h"
#include "lang/program/program.h"

#include <cstdint>

namespace cascade::checking {

/// The smallest length of a cell. The largest length is the inverse of this number. The squares of
/// both are normal numbers.
inline constexpr double least_spacing = 1e-15;

/// Whether any statement of the script may make the lengths of the domain change during a stage.
/// The domain must have been checked.
bool lengths_may_grow(const Program& program, const ast::Script& script);

/// Checks `extent` in the domain. Sets the spacing so that the sides of the grid have the given
/// lengths at t = 0. The grid must be known.
void check_extent(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// Checks `extent` in the domain of a surface or model, whose longest side it is. The surface must
/// have been checked.
void check_extent_of_surface(Workspace& work, const ast::Script& script,
                             const ast::Statement& statement);

/// Checks `extent` in a stage.
void check_stage_extent(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                        Stage& stage);

/// Gives the stage the growth of the domain, unless the stage sets lengths itself. Also sets which
/// species growth does not dilute.
void fill_growth(Stage& stage, const DomainSettings& domain, const Settings& own,
                 const Settings& defaults);

/// Whether a formula of a stage has a meaning if the stage's domain grows. If not, reports an error
/// at the first function without a meaning.
bool can_grow(const Program& program, std::uint32_t stage, const Formula& formula,
              Diagnostics& diagnostics);

/// Reports stages that cannot run in their growing domain. In such a stage, a length is not above 0
/// or jumps, or a part of the stage has no meaning in a growing domain. The program must have no
/// other errors, and growth must not have been written into its equations yet.
void check_growth(const Program& program, Diagnostics& diagnostics);

}  // namespace cascade::checking
