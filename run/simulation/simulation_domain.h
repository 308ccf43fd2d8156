// What a simulation computes, and on which cells. Stages change none of it.
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

/// A model as a domain.
struct DomainModel {
    std::shared_ptr<const ModelCells> cells;
    std::unique_ptr<SurfaceValues> values;  ///< What formulas read from places on it.
};

struct SimulationDomain {
    /// As it runs: lengths of stages with a size are scaled.
    std::shared_ptr<const Program> program;
    Grid grid;  ///< Of a model: the rows in which its cells lie.
    std::optional<DomainMask> mask = {};
    std::optional<DomainModel> model = {};
    double memory = 0;  ///< Bytes of all planes that the simulation holds at one time.
    /// By what lengths of stages were multiplied, under keys that say for what.
    std::map<std::string, double> known_sizes = {};

    const Stage& stage(std::uint32_t k) const { return program->stages[k]; }
    Precision precision() const { return program->domain.precision; }
    /// Null if all cells belong to the domain.
    const DomainMask* inside() const { return mask ? &*mask : nullptr; }
    /// The cells of the model, for another simulation on it; null on grids.
    std::shared_ptr<const ModelCells> shared_model() const {
        return model ? model->cells : nullptr;
    }
};

}  // namespace cascade
