// The program that a simulation computes, and its cells. Stages change neither the program nor the
// cells.
#pragma once

#include "core/grid.h"
#include "lang/program/program.h"
#include "run/domain/domain_mask.h"
#include "run/domain/model_cells.h"
#include "run/domain/surface_values.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace cascade {

/// A model whose surface is the domain.
struct DomainModel {
    std::shared_ptr<const ModelCells> cells;
    /// The values that formulas read at positions on the model.
    std::unique_ptr<SurfaceValues> values;
};

struct SimulationDomain {
    /// The program that runs, in which the lengths of stages with a size have been scaled.
    std::shared_ptr<const Program> program;
    /// The grid. On a model, it consists of the rows and columns in which the model's cells are
    /// stored.
    Grid grid;
    std::optional<DomainMask> mask = {};
    std::optional<DomainModel> model = {};
    double memory = 0;  ///< Bytes of all planes that the simulation holds at the same time.
    /// The factors by which lengths of stages were scaled, by keys. The key of a factor describes
    /// the trial run that found it.
    std::map<std::string, double> known_sizes = {};

    const Stage& stage(std::uint32_t k) const { return program->stages[k]; }
    Precision precision() const { return program->domain.precision; }
    /// Returns the mask, or null if all cells belong to the domain.
    const DomainMask* inside() const { return mask ? &*mask : nullptr; }
    /// Returns the cells of the model, which another simulation can share. Returns null on grids.
    std::shared_ptr<const ModelCells> shared_model() const {
        return model ? model->cells : nullptr;
    }
};

}  // namespace cascade
