// Stores a model and its cells as bytes, for exported pages. A page contains the engine that runs
// the simulation, but neither the libraries that read a model's file nor code to spread its cells
// quickly.
#pragma once

#include "mesh/surface_mesh.h"
#include "run/domain/model_cells.h"
#include "surface/surface_cells.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct CarriedModel {
    SurfaceMesh mesh;  ///< Turned so that y points upwards.
    std::vector<std::string> repairs;
    SurfaceCells cells;
};

/// Prints a model as bytes, with numbers in the byte order of this machine. Browsers can read them
/// only if this order is little-endian, as on x86-64.
std::string print_carried_model(const ModelCells& model);
/// Fails if the bytes are incomplete or describe no model.
Result<CarriedModel> parse_carried_model(std::string_view bytes);

/// Makes the cells of a program's domain. make_model_cells() would return the same result for this
/// mesh.
std::shared_ptr<const ModelCells> link_carried_model(const Program& program, CarriedModel model);

}  // namespace cascade
