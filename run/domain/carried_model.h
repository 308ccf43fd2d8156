// A model with its cells as bytes, for pages that carry their engine. Reading a model's file and
// spreading its cells needs libraries and time that a page lacks.
#pragma once

#include "mesh/surface_mesh.h"
#include "run/domain/model_cells.h"
#include "surface/surface_cells.h"

#include <string>
#include <string_view>
#include <vector>

namespace cascade {

struct CarriedModel {
    SurfaceMesh mesh;  ///< Upright.
    std::vector<std::string> repairs;
    SurfaceCells cells;
};

/// Numbers have the byte order of the machine. Browsers use that of x86-64.
std::string print_carried_model(const ModelCells& model);
/// Fails if the bytes are truncated or do not hold a model.
Result<CarriedModel> parse_carried_model(std::string_view bytes);

/// The cells of a program's domain, as make_model_cells() makes them of the same mesh.
std::shared_ptr<const ModelCells> link_carried_model(const Program& program, CarriedModel model);

}  // namespace cascade
