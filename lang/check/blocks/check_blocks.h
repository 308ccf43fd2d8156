// Checks of the blocks of a script (internal to the checker). Each function adds its results to the
// workspace's program.
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/names/check_names.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/check/systems/system_inheritance.h"
#include "lang/program/shape_form.h"

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace cascade::checking {

/// Whether the override changes the `extent` or the `spacing` of the domain, as `--set extent=4`
/// does. Such an override replaces both settings of the script. If a parameter is called `extent`
/// or `spacing`, the override changes the parameter.
bool is_of_domain(const ast::Script& script, const ast::Override& change);

/// For each stage, the overrides that apply to the stage, in order.
using StageOverrides = std::vector<std::vector<const ast::Statement*>>;

/// Finds the stages to which each override applies.
StageOverrides distribute_overrides(Workspace& work, const ast::Script& script);

/// Adds the stages of a script, but not yet their systems. `has_cells(name)` returns whether the
/// system with this name is a block of cells.
void add_stages(Workspace& work, const ast::Script& script,
                const std::function<bool(std::string_view)>& has_cells);
/// The stage blocks of a script. If there are more stages than a script may have, only as many as
/// it may have.
std::vector<const ast::Block*> stage_blocks(const ast::Script& script);
/// Gives each stage its system if that system has already been added. `all_are_known` says that all
/// systems have been added. In this case, a system name that is not found is reported as an error.
void find_systems_of_stages(Workspace& work, const ast::Script& script, bool all_are_known);
/// Checks all stages of a script, including overrides and the options that apply to all stages.
void check_stages(Workspace& work, const ast::Script& script);

/// Checks the rules that the block of system `index` gives its species at the sides. The system
/// gets these rules and the rules of `base`, the system from which it is derived.
void check_system_sides(Workspace& work, const ast::Script& script, const ast::Block& block,
                        SystemId index, std::optional<SystemId> base);

/// Checks a statement of the domain that gives a rule at a side for all species.
void check_domain_side(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// Determines the rules at the sides for all stages. Systems, stages and the domain must have been
/// checked.
void check_stage_sides(Workspace& work, const ast::Script& script);

/// For each stage, the overrides of rules at its sides, in order.
using SideOverrides = std::vector<std::vector<ast::Statement>>;
SideOverrides distribute_side_overrides(Workspace& work, const ast::Script& script);

/// Whether the word is left, right, top, bottom, front, back or sides.
bool is_side_word(std::string_view word);

/// The script's only block of this kind; null if there is none. If there is a second block of this
/// kind, reports it. `name` is the name of the kind in messages.
const ast::Block* find_block(Workspace& work, const ast::Script& script, ast::BlockKind kind,
                             std::string_view name);

/// Reports rules at sides for single species in a block that cannot contain such rules.
void report_sides(Workspace& work, const ast::Block& block);

/// Checks the `domain` block, if there is one, and the options for the domain.
void check_domain(Workspace& work, const ast::Script& script);

/// Whether a setting of the domain belongs to a model.
bool is_model_setting(std::string_view name);
/// Whether the value of `surface:` names a shape, such as sphere. Otherwise the value consists of
/// three expressions.
bool is_model_surface(const ast::Script& script, const ast::Statement& surface);
/// Checks the settings of a model. If neither the block nor an option names a model, reports
/// settings of models as errors and returns false.
bool check_model(Workspace& work, const ast::Script& script, const ast::Block& domain);

/// The part of the domain whose length `extent` in the domain's block sets.
enum class ExtentOf : std::uint8_t {
    grid,
    surface,  ///< The block's surface or model.
    nothing,  ///< A model of the command line replaces the block's grid.
};
ExtentOf subject_of_extent(const ast::Script& script, const ast::Block& domain);

/// Checks the settings of the domain that belong to a surface. The grid must be known.
void check_surface(Workspace& work, const ast::Script& script, const ast::Block& domain);

/// Checks the `picture` block, if there is one. Names in the block refer to the last stage that
/// takes a step. `shapes` is the result of check_shapes().
void check_picture(Workspace& work, const ast::Script& script,
                   const std::vector<ShapeForm>& shapes);

}  // namespace cascade::checking
