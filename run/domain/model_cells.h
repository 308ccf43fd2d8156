// The cells of a model, as a domain: where they lie, what is known of them, and their links.
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
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cascade {

struct ModelCells : ModelFacts {
    /// Turned upright: y points upwards, whatever axis does so in the file. Nothing but what writes
    /// files of the model, in whose own coordinates they are, has to know.
    SurfaceMesh mesh;
    Axis up = Axis::y;                 ///< Of the model before it was turned.
    std::vector<std::string> repairs;  ///< What was done to the model, a sentence each.
    SurfaceCells cells;
    /// Cells lie in memory as steps are fastest (surface/cell_order.h): order[k] is the cell at
    /// column k mod W of row k / W. Only planes and links do; whatever leaves a run, and random
    /// numbers, have the cells in their own order.
    std::vector<std::uint32_t> order;
    Mask inside;                ///< 0 in what fills up the last row, else 1.
    double unit = 1;            ///< In lengths of the model.
    std::vector<Field> planes;  ///< By ModelPlane.
    /// Without weights of gradients until need_gradients() has been called: few scripts ask for
    /// them.
    mutable Links links;

    /// Gives the links the weights of gradients, on the first call. From one thread at a time.
    /// Throws std::bad_alloc.
    void need_gradients() const;

    /// The mesh as it was before it was turned upright, bit for bit.
    SurfaceMesh mesh_of_file() const;

    std::size_t count() const { return cells.places.size(); }
    /// The cell at place k of the rows, k below their number.
    std::uint32_t cell_at(std::int64_t k) const { return order[static_cast<std::size_t>(k)]; }

private:
    mutable bool has_gradients_ = false;
};

/// Where the file of a model may lie.
struct ModelAccess {
    std::filesystem::path folder;  ///< Paths are relative to it.
    ReadAccess reads;
    bool is_asked_for = false;    ///< On the command line: the file may lie anywhere.
    std::filesystem::path cache;  ///< Where cells that are spread are kept; empty: nowhere.
};

/// Reads or makes the model, spreads its cells and links them. Fails, in words, on a file that
/// cannot be used, on more cells than memory and on fewer than pieces; what it returns means
/// nothing if it was cancelled. The same on any number of threads.
Result<std::shared_ptr<const ModelCells>> make_model_cells(const Program& program,
                                                           const ModelAccess& access, Team& team,
                                                           RunControl& control);

/// Coordinates of scripts, 0 … 1 along the longest side of the model's box and in the same scale
/// along the others, and those of the model.
struct ModelBox {
    Vector3d low;
    double longest = 0;  ///< In lengths of the model.

    explicit ModelBox(const SurfaceMesh& mesh);
    Vector3d in_model(Vector3d place) const { return low + place * longest; }
    Vector3d in_script(Vector3d place) const { return (place - low) * (1 / longest); }
};

/// One value for each cell as a plane; what fills the last row is like the last cell.
Field field_of_cells(std::span<const double> values, const ModelCells& model, Precision precision);

/// A plane's cells in one row and in their own order, as files have them, and back, with those that
/// fill the last row.
Field in_one_row(const Field& field, const ModelCells& model);
Field in_rows(const Field& one_row, const ModelCells& model);

/// The values of a plane's cells in their own order, without those that fill the last row.
std::vector<double> cell_values(const Field& field, const ModelCells& model);

}  // namespace cascade
