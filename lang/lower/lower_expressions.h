// Turns formulas into the expression graph of a plan (internal to lowering).
#pragma once

#include "lang/lower/plan_graph.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::lowering {

/// The starting values of the items of a stage. Each item may read items that come before it in
/// `items`.
Expressions flat_start(const Program& program, std::uint32_t stage, std::span<const ItemId> items);
/// The rates of a stage's species, in the order of System::rate_order, followed by the bounds of
/// the stage's invariants. If the solver is implicit in each cell, the derivatives of the rates
/// with respect to the species follow, row by row. All plans of a step use this function, so they
/// number nodes in the same way.
Expressions flat_step(const Program& program, std::uint32_t stage);
/// The values of the given formulas.
Expressions flat_formulas(std::span<const Formula* const> formulas, const PassContext& context,
                          const Noise& noise = {});

/// A pass of lowering: which domains need it, which nodes it changes, and the function that turns
/// one graph into another.
struct PassInfo {
    std::string_view name;
    bool (*is_about)(const PassContext& context);
    bool (*changes)(const Node& node);
    Expressions (*run)(const Expressions& from, const PassContext& context);
};
/// All passes, in order.
std::span<const PassInfo> graph_passes();

/// Called first with "flatten" and the expressions before all passes, and then with the name of
/// each pass and the expressions after this pass.
using PassWatch = std::function<void(std::string_view pass, const Expressions& after)>;

/// Runs the passes that the context needs.
Expressions lower_expressions(Expressions flat, const PassContext& context,
                              const PassWatch& watch = {});

/// Calls watch(context, what, pass, after) for the passes of a program's starting values, steps and
/// pictures. `what` names one of these three.
using LoweringWatch = std::function<void(const PassContext& context, std::string_view what,
                                         std::string_view pass, const Expressions& after)>;
void watch_lowering(const Program& program, const LoweringWatch& watch);

/// The expressions as text, with a line for each node.
std::string print(const Expressions& expressions, const PassContext& context);

}  // namespace cascade::lowering
