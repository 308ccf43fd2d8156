// Makes the cells of a surface: around spread positions, or from the faces or points of a mesh.
#pragma once

#include "core/parallel.h"
#include "core/result.h"
#include "surface/anisotropy.h"
#include "surface/relax.h"
#include "surface/surface_cells.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace cascade {

/// One cell around each point, with the point's index. The cell's area is the mixed Voronoi area.
/// The weight of the Voronoi edge across an edge of the mesh is (cot α + cot β) / 2, where α and β
/// are the angles opposite the edge of the mesh (M. Meyer, M. Desbrun, P. Schröder and A. Barr,
/// "Discrete Differential-Geometry Operators for Triangulated 2-Manifolds", 2003, sections 3.3 and
/// 3.5). This is the method of linear finite elements with lumped masses.
///
/// Obtuse angles could give negative weights, with which substance would flow towards higher
/// concentration. So areas and weights are taken from the intrinsic Delaunay triangulation of the
/// surface (mesh/intrinsic_delaunay.h), which is the mesh itself if the two angles opposite each
/// edge add up to at most 180°. A boundary edge opposite an obtuse angle has no Voronoi edge. The
/// areas sum to the area of the surface.
SurfaceCells vertex_cells(const SurfaceMesh& mesh);

/// One cell for each face of the model, in the order of their first triangles. A face is a
/// triangle, or the triangles of one polygon (SurfaceMesh::faces). The edges between faces are
/// Voronoi edges. This follows R. Mills, D. Newman, S. Smith and Q. Y. Zhang, "Morphogenesis and
/// Skin Pattern Generation for 3D Models" (University of Southampton, 2005), who give each triangle
/// of a model three neighbours and weight diffusion by the lengths of edges.
///
/// A triangle's cell is at its circumcentre, another polygon's cell at its centroid. The distance
/// across an edge is the sum of the two cells' distances from the edge's line. Without obtuse
/// angles the cells therefore form a Voronoi diagram and diffusion is consistent (R. Eymard, T.
/// Gallouët and R. Herbin, "Finite Volume Methods", 2000, section 9). An obtuse triangle has its
/// circumcentre outside, and a right-angled triangle on an edge. Such a centre is moved inside
/// until every corner has a weight of at least 1/9, which bounds the weights of edges. Diffusion
/// then has an error, of up to a tenth on squares cut in two.
SurfaceCells face_cells(const SurfaceMesh& mesh);

/// The cell of each triangle's face.
std::vector<std::uint32_t> cells_of_triangles(const SurfaceMesh& mesh);

enum class CellKind : std::uint32_t {
    places = 0,    ///< Regions around uniformly spread positions (surface/voronoi_cells.h).
    faces = 1,     ///< The faces of the model.
    vertices = 2,  ///< The points of the model.
};

struct CellOptions {
    CellKind kind = CellKind::places;
    // The members below are for `places` only.
    std::uint64_t count = 0;  ///< 1 … 2³² − 2.
    std::uint32_t seed = 1;
    int rounds = relaxing_rounds;  ///< Number of rounds of relaxation.
    /// Null for an isotropic metric. The anisotropy must exist while cells are made.
    const Anisotropy* anisotropy = nullptr;
    /// Called with the completed part of the work, 0 … 1; may be empty.
    std::function<void(double)> progress = {};
};

/// The number of cells that make_cells() will make.
std::uint64_t count_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// An upper estimate, from measurements, of the bytes needed to make the cells, without the mesh.
/// Serves to refuse impossible requests in advance.
double memory_of_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// Fails if make_cells() would fail.
Result<void> check_cells(const SurfaceMesh& mesh, const CellOptions& options);

/// Makes the cells. Fails if the number of cells is out of range, or if the surface has more
/// components than cells, since each component needs a cell. Also fails if an anisotropy lacks a
/// direction or a ratio ≥ 1 for some triangle. Throws std::bad_alloc. The result is the same with
/// any number of threads. It is undefined if `cancel` became true.
Result<SurfaceCells> make_cells(const SurfaceMesh& mesh, const CellOptions& options, Team& team,
                                const std::atomic<bool>& cancel);

}  // namespace cascade
