// Collapses of short edges.
#pragma once

#include "mesh/half_edges.h"

namespace cascade {

/// Collapses edges shorter than `shortest` to their midpoints, in order of their faces, if that
/// preserves the shape of the surface: the link condition holds (T. Dey et al., "Topology
/// Preserving Edge Contraction", Publ. Inst. Math. Beograd 66, 1999), no triangle rotates by more
/// than 75°, and no edge becomes longer than `longest`. The mesh must be closed, without double
/// edges.
void collapse_edges(HalfEdges& mesh, double shortest, double longest);

}  // namespace cascade
