// Checking the blocks of a script (internal to the checker). Each adds to the workspace's program.
#pragma once

#include "lang/check_expression.h"
#include "lang/check_names.h"

namespace cascade::checking {

/// A `system` block. The system is added even where it has faults, so that what reads it does not
/// give messages of its own.
void check_system(Workspace& work, const ast::Script& script, const ast::Block& block,
                  bool built_in);

/// All stages of a script, with the overrides.
void check_stages(Workspace& work, const ast::Script& script);

/// The `domain` block, if there is one.
void check_domain(Workspace& work, const ast::Script& script);

/// The `picture` block, if there is one: read as by the last stage that takes a step.
void check_picture(Workspace& work, const ast::Script& script);

/// Warns of parameters and definitions that nothing reads.
void warn_unread(Workspace& work);

// Settings that stand in systems and stages.

/// `iterations` or `interval`: a whole number in its range.
std::optional<std::int64_t> check_count(Workspace& work, const ast::Script& script,
                                        const ast::Sentence& sentence);

/// The only value of a sentence; an error at the second where it has more.
bool has_one_value(Workspace& work, const ast::Script& script, const ast::Sentence& sentence);

/// Sets a setting of this name: iterations, interval, frozen, speed or show.
void check_setting(Workspace& work, const ast::Script& script, const ast::Sentence& sentence,
                   const Scope& scope, Settings& settings);

}  // namespace cascade::checking
