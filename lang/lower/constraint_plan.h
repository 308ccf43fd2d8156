// The plans from which the field of a constraint is found (internal to lowering).
#pragma once

#include "lang/lower/plan_graph.h"
#include "lang/lower/step_plan.h"

namespace cascade::lowering {

/// `solved` is a node of Function::solved, whose operand is linear in its unknown, as the checker
/// has made sure.
Solve plan_of_constraint(const PlanGraph& graph, NodeId solved, TemporaryId target);

}  // namespace cascade::lowering
