// Diffusion between the nodes of a graph, for smoothing what they hold.
#pragma once

#include "core/parallel.h"
#include "mesh/flat.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace cascade {

/// A link as its node sees it. What comes over it is multiplied by `coupling`: a weight, or with
/// Number = Vector2d a weight and a turn as the product of complex numbers.
template <typename Number>
struct GraphLink {
    std::uint32_t neighbour = 0;
    double weight = 0;  ///< Not negative; the same on both sides.
    Number coupling{};  ///< As large as the weight; on the other side it turns the other way.
};

template <typename Number>
struct DiffusionGraph {
    std::vector<double> masses;     ///< Of each node, above 0 where it has links.
    std::vector<std::size_t> ends;  ///< Node k's links end before links[ends[k]].
    std::vector<GraphLink<Number>> links;
};

/// The solution of mass_i dv_i/dt = Σ coupling v_j − weight v_i after some time, by four implicit
/// steps of Euler's, each solved by conjugate gradients until what is wrong is 10⁻⁶ of what was at
/// first (J. Shewchuk, "An introduction to the conjugate gradient method without the agonizing
/// pain", 1994, appendix B3; the preconditioner is the diagonal). Stable for any time; more than
/// 100 times the total mass counts as that. Numbers that are not finite spread. The same on any
/// number of threads; means nothing if `cancel` became true.
std::vector<double> diffused(const DiffusionGraph<double>& graph, std::vector<double> values,
                             double time, Team& team, const std::atomic<bool>& cancel);
std::vector<Vector2d> diffused(const DiffusionGraph<Vector2d>& graph, std::vector<Vector2d> values,
                               double time, Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
