// Making a model's cells from its mesh: spread or taken from its faces and points, then linked and
// laid out in the order of memory.
#pragma once

#include "run/domain/model_cells.h"

#include <atomic>
#include <filesystem>

namespace cascade {

/// All that determines the cells besides the mesh.
struct CellRequest {
    ModelSettings settings;
    std::uint32_t seed = 1;
    Precision precision = Precision::single;
    std::int64_t detail = 1;      ///< As in DomainSettings.
    std::filesystem::path cache;  ///< Folder for spread cells. Empty: none.

    explicit CellRequest(const Program& program, std::filesystem::path kept_in = {})
        : settings(*program.domain.model),
          seed(program.domain.seed),
          precision(program.domain.precision),
          detail(program.domain.detail),
          cache(std::move(kept_in)) {}

    /// The number of cells of an upright mesh.
    std::size_t count(const SurfaceMesh& mesh) const;
    /// Fails if there is not enough memory for them, or if a component of the surface would have
    /// none.
    Result<void> check(const SurfaceMesh& mesh) const;
    /// Reads the cells from the cache or makes them. Fails as make_cells() does, so never if
    /// check() passed and cells are not stretched. Meaningless if `control` cancels.
    Result<SurfaceCells> make(const SurfaceMesh& mesh, Team& team, const RunControl& control) const;
    /// Adds planes and links.
    SpreadCells linked(const SurfaceMesh& mesh, SurfaceCells cells) const;
};

}  // namespace cascade
