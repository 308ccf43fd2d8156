// Checks of the blocks of a script (internal to the checker). Each adds to the workspace's program.
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/names/check_names.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/check/systems/system_inheritance.h"
#include "lang/program/shape_form.h"

#include <functional>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// Is it the `extent` or the `spacing` of the domain, as `--set extent=4` gives it? It replaces
/// both of the script. A parameter of that name comes first.
bool is_of_domain(const ast::Script& script, const ast::Override& change);

/// The overrides of each stage, in order.
using StageOverrides = std::vector<std::vector<const ast::Statement*>>;

/// Finds the stages that each override applies to.
StageOverrides distribute_overrides(Workspace& work, const ast::Script& script);

/// Adds the stages of a script, without their systems; `has_cells` says of which names of systems
/// are blocks of cells.
void add_stages(Workspace& work, const ast::Script& script,
                const std::function<bool(std::string_view)>& has_cells);
/// The stage blocks of a script, up to the largest number that it may have.
std::vector<const ast::Block*> stage_blocks(const ast::Script& script);
/// Gives stages their systems, where these are known by now. If all are, reports the unknown ones.
void find_systems_of_stages(Workspace& work, const ast::Script& script, bool all_are_known);
/// Checks all stages of a script, with the overrides and the options for all
/// stages.
void check_stages(Workspace& work, const ast::Script& script);

/// Checks the sides that the block of system `index` gives its species, added to
/// those of system `base`, which it is derived from.
void check_system_sides(Workspace& work, const ast::Script& script, const ast::Block& block,
                        SystemId index, std::optional<SystemId> base);

/// Checks a statement of the domain about a side, for all species.
void check_domain_side(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// Resolves the sides of all stages; systems, stages and the domain must have been
/// checked.
void check_stage_sides(Workspace& work, const ast::Script& script);

/// Overrides of sides: for each stage, in their order.
using SideOverrides = std::vector<std::vector<ast::Statement>>;
SideOverrides distribute_side_overrides(Workspace& work, const ast::Script& script);

/// left, right, top, bottom, front, back or sides.
bool is_side_word(std::string_view word);

/// The script's only block of this kind, `name` in messages; null if it has none. Reports a second
/// one.
const ast::Block* find_block(Workspace& work, const ast::Script& script, ast::BlockKind kind,
                             std::string_view name);

/// Reports rules for sides of a single species in a block that cannot have them.
void report_sides(Workspace& work, const ast::Block& block);

/// Checks the `domain` block, if there is one, and the options for the domain.
void check_domain(Workspace& work, const ast::Script& script);

/// True for settings of the domain that belong to a model.
bool is_model_setting(std::string_view name);
/// True if `surface:` names a shape, such as sphere, instead of giving three
/// expressions.
bool is_model_surface(const ast::Script& script, const ast::Statement& surface);
/// Checks the settings of a model. Returns false, having reported any of them as
/// errors, if neither the block nor an option names a model.
bool check_model(Workspace& work, const ast::Script& script, const ast::Block& domain);

/// Checks the settings of the domain that belong to a surface; the grid must be
/// known.
void check_surface(Workspace& work, const ast::Script& script, const ast::Block& domain);

/// Checks the `picture` block, if there is one, as read by the last stage that
/// takes a step; `shapes` are those of check_shapes().
void check_picture(Workspace& work, const ast::Script& script,
                   const std::vector<ShapeForm>& shapes);

}  // namespace cascade::checking
