// The ground on which the cells of a script crawl: its model, plane or box, or a grown body.
#pragma once

#include "run/stage/bound_kernel.h"
#include "tissue/sense_kernel.h"
#include "tissue/surroundings.h"

#include <memory>
#include <vector>

namespace cascade {

/// The surroundings of tissues, in script lengths.
class TissueGround {
public:
    /// `model` is null on grids. Otherwise it must outlive the ground. Throws std::bad_alloc.
    TissueGround(const Grid& grid, const ModelCells* model);
    /// On the surface of a body in the volume of a grid, in script lengths.
    TissueGround(const Grid& grid, SurfaceMesh body);

    const std::shared_ptr<const Surroundings>& surroundings() const { return surroundings_; }
    /// The surface of a body, in script lengths. Null without one.
    std::shared_ptr<const SurfaceMesh> body() const { return model_ == nullptr ? mesh_ : nullptr; }

    /// The value that a cell senses by the name of a plane. Values in the cells of the domain are
    /// current, read through `fields`, which reads the domain's own planes.
    Sense sense_of(const PlaneSource& source, const BindingContext& fields) const;

private:
    PlaceValue value_of(const Field& field) const;
    PlaceValue part_of_side(std::size_t axis) const;

    Grid grid_;
    const ModelCells* model_;
    std::shared_ptr<const SurfaceMesh> mesh_;  ///< The model's or the body's. Otherwise null.
    /// The model's filter, made for the first value read in its cells.
    mutable std::unique_ptr<CellFilter> filter_;
    std::shared_ptr<const Surroundings> surroundings_;
};

/// The planes that plans read and cells sense, each once.
std::vector<PlaneSource> sensed_by(std::span<const StepPlan* const> plans);

}  // namespace cascade
