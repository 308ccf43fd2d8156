// Stores a model and its cells as bytes, for exported pages. A page contains the engine that runs
// the simulation. It contains neither the libraries that read a model's file nor code that spreads
// the model's cells quickly.
#pragma once

#include "mesh/surface_mesh.h"
#include "run/domain/model_cells.h"
#include "surface/surface_cells.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct CarriedModel {
    SurfaceMesh mesh;  ///< The mesh, turned so that y points upwards.
    std::vector<std::string> repairs;
    SurfaceCells cells;
};

/// Writes a model as bytes, with numbers in the byte order of this machine. Browsers can read the
/// bytes only if this order is little-endian, as on x86-64.
std::string print_carried_model(const ModelCells& model);
/// Fails if the bytes are incomplete or describe no model.
Result<CarriedModel> parse_carried_model(std::string_view bytes);

/// Makes the cells of a program's domain from a carried model. The result is the same as the result
/// of make_model_cells() for the model's mesh.
std::shared_ptr<const ModelCells> link_carried_model(const Program& program, CarriedModel model);

}  // namespace cascade
