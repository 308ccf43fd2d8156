// Creation of the cells of a surface, of every kind.
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
    places = 0,    ///< Regions around evenly spread places (surface/voronoi_cells.h).
    faces = 1,     ///< The faces of the model (surface/face_cells.h).
    vertices = 2,  ///< Its points (surface/vertex_cells.h).
};

struct CellOptions {
    CellKind kind = CellKind::places;
    // The following members are for places only.
    std::uint64_t count = 0;  ///< 1 … 2³² − 2.
    std::uint32_t seed = 1;
    int rounds = relaxing_rounds;  ///< Of relaxation.
    /// Null for an isotropic metric. It must exist while cells are made.
    const Anisotropy* anisotropy = nullptr;
};

/// The number of cells that make_cells() would make.
std::uint64_t count_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// An upper estimate, from measurements, of the bytes that making the cells takes besides the mesh,
/// to refuse impossible requests in advance.
double memory_of_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// Fails where make_cells() would.
Result<void> check_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// The cells. Fails if the number of cells is out of range, if there are fewer places than
/// components of the surface (each needs one to be covered), and if the anisotropy is not one
/// direction and ratio ≥ 1 for each triangle. Throws std::bad_alloc. Undefined if `cancel` became
/// true. The same on any number of threads.
Result<SurfaceCells> make_cells(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                const std::atomic<bool>& cancel);

}  // namespace cascade
