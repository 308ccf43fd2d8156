// Diffusion along a direction, as weights of links: linear finite elements on the triangles between
// cells.
#pragma once

#include "core/parallel.h"
#include "surface/cell_triangles.h"
#include "surface/conduction.h"

#include <atomic>
#include <span>
#include <vector>

namespace cascade {

/// The links over which values diffuse by tensors, and the terms that tensors add to the weights of
/// links.
///
/// The tensor of a cell is γ + v vᵀ: diffusion at the rate γ in all directions, and at the rate
/// |v|² along v. Values change as
///
///     de_i/dt = Σ_j W_ij (e_j − e_i) / A_i,    W_ij = f_ij (γ_i + γ_j) / 2 + V_ij,
///
/// where f and A are the flows and areas of Conduction. The energy ½ Σ V_ij (e_j − e_i)² over all
/// links equals the energy of linear finite elements, Σ S/3 ½ (v · ∇e)² over the corners of all
/// triangles between cells. Here S is the area of the triangle, v belongs to the cell at the
/// corner, and ∇e is measured in that cell's plane. V_ij = V_ji, so Σ A e is conserved. The energy
/// is never negative although some V are, so no wave grows.
///
/// Narrow triangles would make steps short. Let s be the largest sum of flows per area in any cell.
/// If a v of length 1 adds terms to the links of a cell whose absolute values sum to more than s
/// per area, |v|² is reduced until they sum to s. So the bound of a step for the rate γ + |v|² in
/// all directions holds for the tensor.
class TensorConduction {
public:
    /// `frames` are the frames of the cells, and `conduction` their flows and areas. The result is
    /// the same with any number of threads. It is undefined if `cancel` became true.
    TensorConduction(const SurfaceMesh& mesh, const SurfaceCells& cells, const CellFrames& frames,
                     const Conduction& conduction, Team& team, const std::atomic<bool>& cancel);

    /// The links of each cell: first its Voronoi edges, in their order, then the links to cells
    /// with which it shares a triangle but no edge. The links of cell k end before ends()[k].
    const std::vector<std::size_t>& ends() const { return links_.ends; }
    const std::vector<VoronoiEdge>& links() const { return links_.edges; }
    /// The factor of (e_j − e_i) in de_i/dt for each link if γ is 1 and v is 0 in all cells.
    std::vector<double> isotropic() const;
    /// The factors for the tensors of the cells: `low` is γ, and `along` is v in the frame of the
    /// cell, the component along `right` first.
    std::vector<double> weights(std::span<const double> low, std::span<const Vector2d> along) const;

private:
    /// A corner of a triangle: v adds (v · a d₁ + v · b d₂)² / 2 to the energy, where d₁ and d₂ are
    /// the differences over the links to the other corners.
    struct Corner {
        std::uint32_t cell = 0;
        /// The numbers of three pairs of linked cells.
        std::uint32_t first = 0, second = 0, across = 0;
        Vector2d a, b;
    };

    void add_diagonals(const SurfaceMesh& mesh, const CellTriangles& found);
    void number_pairs(const Conduction& conduction);
    std::size_t link_between(std::uint32_t from, std::uint32_t to) const;
    void add_corner(std::uint32_t cell, std::size_t before, std::size_t after, std::size_t across,
                    Vector2d previous, Vector2d next);
    void limit();

    SurfaceCells links_;  ///< The cells with all links.
    std::vector<double> areas_;
    std::vector<std::uint32_t> pairs_;  ///< The number of the pair of cells that each link joins.
    std::vector<double> flows_;         ///< The flow of each pair; 0 for diagonals.
    std::vector<Corner> corners_;
};

}  // namespace cascade
