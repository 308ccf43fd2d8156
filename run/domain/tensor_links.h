// The links of a model for diffusion with tensors that do not change.
#pragma once

#include "core/links.h"
#include "core/plane.h"
#include "run/domain/model_cells.h"
#include "surface/tensor_conduction.h"

#include <mutex>

namespace cascade {

class TensorLinks {
public:
    /// The model must outlive the links. Throws std::bad_alloc.
    explicit TensorLinks(const ModelCells& model);

    /// The links of the model's cells in the same order, followed by links of weight 0. These lead
    /// from each cell to the cells with which it shares a triangle but no edge.
    const Links& links() const { return links_; }
    /// Returns links() with weights of gradients, which the first call computes. Throws
    /// std::bad_alloc.
    const Links& links_with_gradients() const;
    /// Computes the plane of tensor_weights(low, right, down), which has a number for each link.
    /// The operands have the cells in the order of memory. Throws std::bad_alloc.
    Field weights(const Field& low, const Field& right, const Field& down) const;

private:
    std::vector<double> by_cell(const Field& plane) const;

    const ModelCells& model_;
    TensorConduction conduction_;
    Links links_;
    mutable std::once_flag has_gradients_;
    mutable Links links_with_gradients_;
};

}  // namespace cascade
