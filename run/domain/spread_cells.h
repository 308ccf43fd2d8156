// Makes a model's cells from its mesh. The cells are spread over the mesh, or are its faces or
// points. After that, they are linked and stored in the order that is fastest for steps.
#pragma once

#include "run/domain/model_cells.h"

#include <atomic>
#include <filesystem>

namespace cascade {

/// Everything besides the mesh that determines the cells.
struct CellRequest {
    ModelSettings settings;
    std::uint32_t seed = 1;
    Precision precision = Precision::single;
    std::int64_t detail = 1;  ///< See DomainSettings::detail.
    /// The folder in which spread cells are cached. Empty: they are not cached.
    std::filesystem::path cache;

    explicit CellRequest(const Program& program, std::filesystem::path kept_in = {})
        : settings(*program.domain.model),
          seed(program.domain.seed),
          precision(program.domain.precision),
          detail(program.domain.detail),
          cache(std::move(kept_in)) {}

    /// Returns the number of cells that the settings give to an upright mesh.
    std::size_t count(const SurfaceMesh& mesh) const;
    /// Fails if there is not enough memory for the cells, or if a component of the
    /// surface would have no cell.
    Result<void> check(const SurfaceMesh& mesh) const;
    /// Reads the cells from the cache, or makes them. Fails in the same cases as make_cells().
    /// Cannot fail if check() has succeeded and cells are not stretched. The result is meaningless
    /// if `control` cancels the call.
    Result<SurfaceCells> make(const SurfaceMesh& mesh, Team& team, const RunControl& control) const;
    /// Adds planes and links to the cells.
    SpreadCells linked(const SurfaceMesh& mesh, SurfaceCells cells) const;
};

}  // namespace cascade
