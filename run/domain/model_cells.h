// The cells of a model as a domain: their positions, properties and links.
#pragma once

#include "core/axis.h"
#include "core/granted_files.h"
#include "core/links.h"
#include "core/parallel.h"
#include "core/plane.h"
#include "core/result.h"
#include "core/run_control.h"
#include "lang/program/models.h"
#include "mesh/surface_mesh.h"
#include "surface/surface_cells.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// The cells that are spread over a model, for fields on it.
struct SpreadCells : ModelFacts {
    SurfaceCells cells;
    /// Planes and links have the cells in the fastest order for steps (surface/cell_order.h):
    /// order[k] is the cell at column k mod W of row k / W. Files and random numbers use the cells'
    /// own order.
    std::vector<std::uint32_t> order;
    Mask inside;                ///< 0 in the padding of the last row, else 1.
    double unit = 1;            ///< In lengths of the model.
    std::vector<Field> planes;  ///< By ModelPlane.
    Links links;                ///< Without weights of gradients: few scripts need them.
};

class ModelCells {
public:
    using Make = std::function<SpreadCells(const ModelCells&)>;

    /// The mesh with y upwards, looking along z, independent of its orientation in the file. Only
    /// the writers of model files need the original coordinates.
    SurfaceMesh mesh;
    Stance stance;                     ///< The model's stance in the file.
    std::vector<std::string> repairs;  ///< The repairs of the model, one sentence each.

    /// The first call of spread() calls `make`, once.
    ModelCells(SurfaceMesh upright, std::size_t count, Make make);

    /// Known before the cells are made.
    std::size_t count() const { return count_; }
    /// The rows of cells.
    const Grid& grid() const { return grid_; }
    /// Makes the cells on the first call, because crawling cells may need none of them. Throws
    /// std::bad_alloc.
    const SpreadCells& spread() const;
    /// The links with weights of gradients, computed on the first call. Throws std::bad_alloc.
    const Links& links_with_gradients() const;

    /// The cell at position k of the rows. k is below the number of cells.
    std::uint32_t cell_at(std::int64_t k) const {
        return spread().order[static_cast<std::size_t>(k)];
    }

    /// The mesh before it was turned upright, bit for bit.
    SurfaceMesh mesh_of_file() const;

private:
    std::size_t count_;
    Grid grid_;
    Make make_;
    mutable std::once_flag is_spread_, has_gradients_;
    mutable SpreadCells spread_;
    mutable Links links_with_gradients_;
};

/// Where a model's file may lie.
struct ModelAccess {
    std::filesystem::path folder;  ///< Paths are relative to this folder.
    ReadAccess reads;
    bool is_asked_for = false;    ///< The command line names it: the file may lie anywhere.
    std::filesystem::path cache;  ///< Folder for spread cells. Empty: none.
    /// Refuses a model, upright, before its cells are made. May be empty.
    std::function<Result<void>(const SurfaceMesh&)> check = {};
    bool is_made_when_read = false;  ///< The first call of spread() makes the cells.
};

/// Reads or makes the model, spreads its cells and links them. Fails on an unusable file, on more
/// cells than memory allows and on fewer cells than components. The result is meaningless if the
/// call was cancelled. The same with any number of threads. `control` is not kept: cells made on
/// reading are neither reported nor cancelled.
Result<std::shared_ptr<const ModelCells>> make_model_cells(const Program& program,
                                                           const ModelAccess& access, Team& team,
                                                           RunControl& control);

/// Converts between script coordinates, 0 … 1 along the longest side of the model's box and in the
/// same scale along the others, and model coordinates.
struct ModelBox {
    Vector3d low;
    double longest = 0;  ///< In lengths of the model.

    explicit ModelBox(const SurfaceMesh& mesh);
    Vector3d in_model(Vector3d place) const { return low + place * longest; }
    Vector3d in_script(Vector3d place) const { return (place - low) * (1 / longest); }
};

/// One value for each cell as a plane. The padding of the last row repeats the last cell.
Field field_of_cells(std::span<const double> values, const ModelCells& model, Precision precision);

/// Converts a plane to one row with the cells in their own order, as in files, and back, padding
/// included.
Field in_one_row(const Field& field, const ModelCells& model);
Field in_rows(const Field& one_row, const ModelCells& model);

/// The values of a plane's cells in their own order, without the padding.
std::vector<double> cell_values(const Field& field, const ModelCells& model);

}  // namespace cascade
