// Diffusion on a graph, for smoothing values at its nodes.
#pragma once

#include "core/parallel.h"
#include "mesh/flat.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace cascade {

/// A link, stored at both of its nodes. The neighbour's value is multiplied by `coupling`: a weight
/// or, for Vector2d, a weight times a rotation as a complex number.
template <typename Number>
struct GraphLink {
    std::uint32_t neighbour = 0;
    double weight = 0;  ///< Not negative, and equal on both sides.
    Number
        coupling{};  ///< The magnitude is the weight. The rotations on the two sides are opposite.
};

template <typename Number>
struct DiffusionGraph {
    std::vector<double> masses;     ///< The nodes' masses. Positive for nodes with links.
    std::vector<std::size_t> ends;  ///< The links of node k end before links[ends[k]].
    std::vector<GraphLink<Number>> links;
};

/// The solution, after `time`, of mass_i dv_i/dt = Σ_j (coupling_ij v_j − weight_ij v_i). Takes
/// four implicit Euler steps, each solved by conjugate gradients until the relative residual is
/// 10⁻⁶ (J. Shewchuk, "An introduction to the conjugate gradient method without the agonizing
/// pain", 1994, appendix B3; diagonal preconditioner). Stable for any time. The time is limited to
/// 100 times the total mass. Numbers that are not finite spread to all connected nodes. The result
/// is the same with any number of threads. It is undefined if `cancel` became true.
std::vector<double> diffused(const DiffusionGraph<double>& graph, std::vector<double> values,
                             double time, Team& team, const std::atomic<bool>& cancel);
std::vector<Vector2d> diffused(const DiffusionGraph<Vector2d>& graph, std::vector<Vector2d> values,
                               double time, Team& team, const std::atomic<bool>& cancel);

}  // namespace cascade
