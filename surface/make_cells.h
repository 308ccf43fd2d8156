// The cells of a surface, of every kind: the one door to them.
#pragma once

#include "core/parallel.h"
#include "core/result.h"
#include "surface/anisotropy.h"
#include "surface/relax.h"
#include "surface/surface_cells.h"

#include <atomic>
#include <cstdint>

namespace cascade {

enum class CellKind : std::uint32_t {
    places = 0,    ///< Regions around places spread evenly (surface/voronoi_cells.h).
    faces = 1,     ///< The faces of the model (surface/face_cells.h).
    vertices = 2,  ///< Its points (surface/vertex_cells.h).
};

struct CellOptions {
    CellKind kind = CellKind::places;
    // The rest is for places only.
    std::uint64_t count = 0;  ///< 1 … 2³² − 2.
    std::uint32_t seed = 1;
    int rounds = relaxing_rounds;  ///< Of relaxation.
    /// Null: lengths count the same in all directions. It must stay while cells are made.
    const Anisotropy* anisotropy = nullptr;
};

/// How many cells there will be.
std::uint64_t count_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// Bytes that making the cells takes at most, besides the mesh: an estimate from what was measured,
/// for refusing what cannot be before it is begun.
double memory_of_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// The cells. Fails on a number of cells out of range, fewer cells than components of the surface
/// (each needs one to be covered; `places` only), and on an anisotropy that is not one direction
/// and ratio ≥ 1 for each triangle. Throws std::bad_alloc. What it returns means nothing if
/// `cancel` became true. The same on any number of threads.
Result<SurfaceCells> make_cells(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                const std::atomic<bool>& cancel);

}  // namespace cascade
