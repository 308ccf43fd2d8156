// Checking one expression (internal to the checker).
#pragma once

#include "lang/check_names.h"

#include <span>

namespace cascade::checking {

/// A checked expression, and its value where it is made of numbers alone.
struct CheckedExpression {
    Formula formula;
    std::optional<double> constant;

    ValueType type() const { return formula.nodes.back().type; }
};

/// Resolves names, counts arguments, checks types and places, and finds divisions by zero. Parts of
/// the formula are in the order of `expression`'s. Nothing is returned where there was a fault; it
/// has been reported then, here or by the parser. Calls of the script's own functions, families and
/// aggregates over an index are written out first.
std::optional<CheckedExpression> check_expression(Workspace& work, const ast::Script& script,
                                                  ast::Expression expression, const Scope& scope);

/// The same for an expression of which nothing needs to be written out any more (expand.h).
std::optional<CheckedExpression> check_parts(Workspace& work, const ast::Script& script,
                                             ast::Expression expression, const Scope& scope);

/// The same for an expression that must be a number (and no colour or text).
std::optional<CheckedExpression> check_number(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope);

/// One number that is known now, in double precision: `subject` names it in messages.
std::optional<double> check_constant(Workspace& work, const ast::Script& script,
                                     ast::Expression expression, std::string_view subject);

/// The value of a function or operator of numbers; nothing where it has none (lap, random, …).
/// There are at least three numbers, the first of which are the operands.
std::optional<double> fold(Function function, std::span<const double> operands);

}  // namespace cascade::checking
