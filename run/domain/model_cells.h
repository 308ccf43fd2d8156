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

/// The cells that are spread over a model. Fields on the model have a value for each.
struct SpreadCells : ModelFacts {
    SurfaceCells cells;
    /// Planes and links have the cells in the order that is fastest for steps
    /// (surface/cell_order.h): order[k] is the cell in column k mod W and row k / W, where W is the
    /// width of the rows. Files and random numbers use the cells' own order.
    std::vector<std::uint32_t> order;
    Mask inside;                ///< 0 in the padding of the last row, else 1.
    double unit = 1;            ///< The script's unit of length, in lengths of the model.
    bool are_spread = true;     ///< False for faces and vertices of the mesh.
    std::vector<Field> planes;  ///< Indexed by ModelPlane.
    Links links;  ///< Without the weights of gradients, because few scripts need them.
};

class TensorLinks;

class ModelCells {
public:
    using Make = std::function<SpreadCells(const ModelCells&)>;

    /// The mesh, turned so that y points upwards and the model faces along z. Only the writers of
    /// model files need the coordinates of the file.
    SurfaceMesh mesh;
    Stance stance;                     ///< The orientation of the model in its file.
    std::vector<std::string> repairs;  ///< One sentence for each repair of the model.

    /// `make` makes the cells. It is called once, by the first call of spread().
    ModelCells(SurfaceMesh upright, std::size_t count, Make make);
    ~ModelCells();

    /// The number of cells, which is known before they are made.
    std::size_t count() const { return count_; }
    /// The grid of memory: the rows and columns in which the cells are stored.
    const Grid& grid() const { return grid_; }
    /// The cells. The first call makes them, because a run with crawling cells may not need them.
    /// Throws std::bad_alloc.
    const SpreadCells& spread() const;
    /// The links with weights of gradients, computed by the first call. Throws std::bad_alloc.
    const Links& links_with_gradients() const;
    /// The weights of gradients, one for each edge of the cells, in the script's unit of length.
    std::vector<Vector3d> gradient_weights() const;
    /// The links over which tensors diffuse, computed by the first call. Throws std::bad_alloc.
    const TensorLinks& tensor_links() const;

    /// The cell at position k, counted row by row. k must be less than the number of cells.
    std::uint32_t cell_at(std::int64_t k) const {
        return spread().order[static_cast<std::size_t>(k)];
    }

    /// The mesh as it was before it was turned upright, bit for bit.
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
    std::filesystem::path cache;  ///< The folder in which spread cells are cached. Empty: no cache.
    /// Checks the upright mesh before its cells are made, and may refuse it. May be empty.
    std::function<Result<void>(const SurfaceMesh&)> check = {};
    bool is_made_when_read = false;  ///< Whether the first call of spread() makes the cells.
                                     ///< Otherwise make_model_cells() does.
};

/// Reads or makes the model, spreads its cells and links them. Fails if the file cannot be used, if
/// there is not enough memory for the cells, or if there are fewer cells than components of the
/// surface. The result does not depend on the number of threads, and is meaningless if the call was
/// cancelled. `control` is used only during this call, so it can neither report nor cancel the
/// making of cells in spread().
Result<std::shared_ptr<const ModelCells>> make_model_cells(const Program& program,
                                                           const ModelAccess& access, Team& team,
                                                           RunControl& control);

/// Converts between the coordinates of scripts and of the model. Script coordinates are 0 … 1 along
/// the longest side of the model's bounding box, and have the same scale along the other sides.
struct ModelBox {
    Vector3d low;
    double longest = 0;  ///< The length of the longest side, in lengths of the model.

    explicit ModelBox(const SurfaceMesh& mesh);
    Vector3d in_model(Vector3d place) const { return low + place * longest; }
    Vector3d in_script(Vector3d place) const { return (place - low) * (1 / longest); }
};

/// Makes a plane from one value for each cell. The padding of the last row repeats the last cell.
Field field_of_cells(std::span<const double> values, const ModelCells& model, Precision precision);

/// in_one_row() converts a plane to a single row with the cells in their own order, as in files.
/// in_rows() is the inverse. Both include the unused positions at the end of the last row.
Field in_one_row(const Field& field, const ModelCells& model);
Field in_rows(const Field& one_row, const ModelCells& model);

/// The values of a plane in the cells' own order, without the unused positions at the end of the
/// last row.
std::vector<double> cell_values(const Field& field, const ModelCells& model);

}  // namespace cascade
