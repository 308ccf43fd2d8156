// Plans for finding the field that a constraint determines (internal to lowering).
#pragma once

#include "lang/lower/plan_graph.h"
#include "lang/lower/step_plan.h"

namespace cascade::lowering {

/// `solved` is a node of Function::solved. The checker ensures that the operand of this node is
/// linear in the unknown field.
Solve plan_of_constraint(const PlanGraph& graph, NodeId solved, TemporaryId target);

}  // namespace cascade::lowering
