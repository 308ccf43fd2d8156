// Checking the blocks of a script (internal to the checker). Each adds to the workspace's program.
#pragma once

#include "lang/check/check_expression.h"
#include "lang/check/check_names.h"
#include "lang/check/system_inheritance.h"

namespace cascade::checking {

/// A system; `base` is the number of the one it is derived from. Returns its number. The system is
/// added even where it has faults, so that what reads it does not give messages of its own; one
/// whose base is not known is not added (unknown_system).
std::uint32_t check_system(Workspace& work, const DerivedSystem& derived,
                           std::optional<std::uint32_t> base);

/// The statement if it gives a value; else null.
const ast::Statement* value_statement(const ast::Statement& statement);

/// What an option of the command line says of this setting; null where it was not given.
const ast::Statement* find_option(const ast::Script& script, std::string_view name);

/// The overrides of each stage, in order.
using StageOverrides = std::vector<std::vector<const ast::Statement*>>;

/// Finds the stages that each override is for.
StageOverrides distribute_overrides(Workspace& work, const ast::Script& script);

/// Is this one of the texts of a system, such as title: "Gray-Scott"? It is taken then.
bool take_text(System& system, const Declaration& declaration);

/// Sets the range of a parameter whose declaration has one; `value` is its default, where known.
void check_range(Workspace& work, const Declaration& declaration, Quantity& quantity,
                 std::optional<double> value);

/// Warns of a value that is known now and lies outside of the parameter's range.
void warn_outside(Workspace& work, const Quantity& quantity, std::optional<double> value,
                  Span span);

/// Says that there is no system of this name.
void report_unknown_system(Workspace& work, const ast::Word& name);

/// All stages of a script, with the overrides and the options about all stages.
void check_stages(Workspace& work, const ast::Script& script);

/// The sides that the block of system `index` gives its species, after those of system `base`,
/// which it is derived from.
void check_system_sides(Workspace& work, const ast::Script& script, const ast::Block& block,
                        std::uint32_t index, std::optional<std::uint32_t> base);

/// A statement of the domain about a side, for all species.
void check_domain_side(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// The sides of all stages, when systems, stages and the domain are known.
void check_stage_sides(Workspace& work, const ast::Script& script);

/// What changes from outside say of sides, by stage, in their order.
using SideOverrides = std::vector<std::vector<ast::Statement>>;
SideOverrides distribute_side_overrides(Workspace& work, const ast::Script& script);

/// left, right, top, bottom, front, back or sides.
bool is_side_word(std::string_view word);

/// The `domain` block, if there is one, and the options about the domain.
void check_domain(Workspace& work, const ast::Script& script);

/// Settings of the domain that belong to a model. True where the block or an option names one; else
/// the settings are faults.
bool is_model_setting(std::string_view name);
/// Does `surface:` name a shape, such as sphere, instead of giving three expressions?
bool is_model_surface(const ast::Script& script, const ast::Statement& surface);
bool check_model(Workspace& work, const ast::Script& script, const ast::Block& domain);

/// Settings of the domain that belong to a surface; looked at when the grid is known.
void check_surface(Workspace& work, const ast::Script& script, const ast::Block& domain);

/// The `picture` block, if there is one: read as by the last stage that takes a step.
void check_picture(Workspace& work, const ast::Script& script);

/// Warns of parameters and definitions that nothing reads; in a system that is derived from another
/// one, what neither changes anything nor is read is an error.
void warn_unread(Workspace& work);

// Settings that stand in systems and stages.

/// `iterations` or `interval`: a whole number in its range.
std::optional<std::int64_t> check_count(Workspace& work, const ast::Script& script,
                                        const ast::Statement& statement);

/// The only value of a statement; an error at the second where it has more.
bool has_one_value(Workspace& work, const ast::Script& script, const ast::Statement& statement);

/// Sets a setting of this name: iterations, interval, frozen, speed or show.
void check_setting(Workspace& work, const ast::Script& script, const ast::Statement& statement,
                   const Scope& scope, Settings& settings);

}  // namespace cascade::checking
