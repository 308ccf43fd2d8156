// The surface or space on which the cells of a script crawl: a model, a plane, a box, or a grown
// body.
#pragma once

#include "run/stage/bound_kernel.h"
#include "tissue/sense_kernel.h"
#include "tissue/surroundings.h"

#include <memory>
#include <vector>

namespace cascade {

/// The surroundings of tissues. Lengths are in the script's unit.
class TissueGround {
public:
    /// Makes the ground of a domain. `model` is null on grids, and must outlive the ground. Throws
    /// std::bad_alloc.
    TissueGround(const Grid& grid, const ModelCells* model);
    /// Makes the ground for the surface of a body in the volume of a grid. The surface has lengths
    /// in the script's unit.
    TissueGround(const Grid& grid, SurfaceMesh body);

    const std::shared_ptr<const Surroundings>& surroundings() const { return surroundings_; }
    /// Returns the surface of a body, in the script's unit of length, or null if there is no body.
    std::shared_ptr<const SurfaceMesh> body() const { return model_ == nullptr ? mesh_ : nullptr; }

    /// Returns a function that gives the value of a plane at a crawling cell. Planes of the domain
    /// are read through `fields` at each call, so their values are current.
    Sense sense_of(const PlaneSource& source, const BindingContext& fields) const;

private:
    PlaceValue value_of(const Field& field) const;
    PlaceValue part_of_side(std::size_t axis) const;

    Grid grid_;
    const ModelCells* model_;
    /// The mesh of a model or of a body. Null on planes and in boxes.
    std::shared_ptr<const SurfaceMesh> mesh_;
    /// The filter that interpolates values of the model's cells. It is made when it is first
    /// needed.
    mutable std::unique_ptr<CellFilter> filter_;
    std::shared_ptr<const Surroundings> surroundings_;
};

/// Returns the planes of the domain that plans read at crawling cells. Each plane occurs once.
std::vector<PlaneSource> sensed_by(std::span<const StepPlan* const> plans);

}  // namespace cascade
