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

/// The cells that are spread over a model. A field on the model has a value for each cell.
struct SpreadCells : ModelFacts {
    SurfaceCells cells;
    /// The order of cells in planes and links, which is the order that is fastest for steps
    /// (surface/cell_order.h). order[k] is the cell in column k mod W and row ⌊k / W⌋, where W is
    /// the width of the rows. Files and random numbers use the cells' own order.
    std::vector<std::uint32_t> order;
    Mask inside;      ///< 1 in the cells, and 0 in the padding of the last row.
    double unit = 1;  ///< The script's unit of length, as a multiple of the model's unit.
    /// Whether the cells were spread. False for faces and vertices of the mesh.
    bool are_spread = true;
    std::vector<Field> planes;  ///< Indexed by ModelPlane.
    /// The links between cells. They have no weights of gradients, because few scripts need these.
    Links links;
};

class TensorLinks;

class ModelCells {
public:
    using Make = std::function<SpreadCells(const ModelCells&)>;

    /// The mesh, turned so that y points upwards and the model looks along z. Only the writers of
    /// model files need the original coordinates.
    SurfaceMesh mesh;
    Stance stance;                     ///< The orientation of the model in its file.
    std::vector<std::string> repairs;  ///< One sentence for each repair of the model.

    /// `make` makes the cells. Only the first call of spread() calls it.
    ModelCells(SurfaceMesh upright, std::size_t count, Make make);
    ~ModelCells();

    /// Returns the number of cells, which is known before they are made.
    std::size_t count() const { return count_; }
    /// Returns the grid of rows and columns in which memory stores the cells.
    const Grid& grid() const { return grid_; }
    /// Returns the cells. The first call makes them, because a run with crawling cells may not need
    /// them. Throws std::bad_alloc.
    const SpreadCells& spread() const;
    /// Returns the links with weights of gradients, which the first call computes. Throws
    /// std::bad_alloc.
    const Links& links_with_gradients() const;
    /// Computes the weights of gradients, one for each edge of the cells, in the script's unit of
    /// length.
    std::vector<Vector3d> gradient_weights() const;
    /// Returns the links over which tensors diffuse, which the first call computes. Throws
    /// std::bad_alloc.
    const TensorLinks& tensor_links() const;

    /// Returns the cell at position k, counted row by row. k must be less than the number of cells.
    std::uint32_t cell_at(std::int64_t k) const {
        return spread().order[static_cast<std::size_t>(k)];
    }

    /// Returns the mesh with the coordinates of its file, bit for bit.
    SurfaceMesh mesh_of_file() const;

private:
    std::size_t count_;
    Grid grid_;
    Make make_;
    mutable std::once_flag is_spread_, has_gradients_, has_tensors_;
    mutable SpreadCells spread_;
    mutable Links links_with_gradients_;
    mutable std::unique_ptr<TensorLinks> tensor_links_;
};

/// The files from which a model may be read.
struct ModelAccess {
    std::filesystem::path folder;  ///< Relative paths start at this folder.
    ReadAccess reads;
    /// Whether the command line names the model. If so, its file may be in any folder.
    bool is_asked_for = false;
    /// The folder in which spread cells are cached. Empty: they are not cached.
    std::filesystem::path cache;
    /// Checks the upright mesh before its cells are made. May refuse the mesh. May be empty.
    std::function<Result<void>(const SurfaceMesh&)> check = {};
    /// Whether the first call of spread() makes the cells. If not, make_model_cells() makes them.
    bool is_made_when_read = false;
};

/// Reads or makes the model, spreads its cells and links them. Fails if the file cannot be used, if
/// there is not enough memory for the cells, or if there are fewer cells than components of the
/// surface. The result does not depend on the number of threads, and is meaningless if the call was
/// cancelled. `control` is used only during this call. If spread() makes the cells, `control` can
/// neither report nor cancel that.
Result<std::shared_ptr<const ModelCells>> make_model_cells(const Program& program,
                                                           const ModelAccess& access, Team& team,
                                                           RunControl& control);

/// Converts between the coordinates of scripts and of the model. Script coordinates are 0 … 1 along
/// the longest side of the model's bounding box, and have the same scale along the other sides.
struct ModelBox {
    Vector3d low;
    double longest = 0;  ///< The length of the longest side, in the model's unit.

    explicit ModelBox(const SurfaceMesh& mesh);
    Vector3d in_model(Vector3d place) const { return low + place * longest; }
    Vector3d in_script(Vector3d place) const { return (place - low) * (1 / longest); }
};

/// Makes a plane from one value for each cell. In the padding of the last row, the value of the
/// last cell is repeated.
Field field_of_cells(std::span<const double> values, const ModelCells& model, Precision precision);

/// in_one_row() converts a plane to a single row with the cells in their own order, as in files.
/// in_rows() converts such a row back to a plane. Both include the unused positions at the end of
/// the last row.
Field in_one_row(const Field& field, const ModelCells& model);
Field in_rows(const Field& one_row, const ModelCells& model);

/// Returns the values of a plane in the cells' own order, without the unused positions at the end
/// of the last row.
std::vector<double> cell_values(const Field& field, const ModelCells& model);

}  // namespace cascade
