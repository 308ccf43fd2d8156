// Short edges collapsed to their midpoints.
#pragma once

#include "mesh/half_edges.h"

namespace cascade {

/// Collapses edges shorter than `shortest` to their midpoints, in order of their faces, where the
/// surface keeps its form: the link condition holds (T. Dey et al., "Topology Preserving Edge
/// Contraction", Publ. Inst. Math. Beograd 66, 1999), no triangle turns by more than 75°, and no
/// edge becomes longer than `longest`. The mesh is closed; between two vertices there is one edge.
void collapse_edges(HalfEdges& mesh, double shortest, double longest);

}  // namespace cascade
