// Draws patterns on a model, from numbers and colours of its cells.
#pragma once

#include "core/palette.h"
#include "picture/image.h"
#include "render/camera.h"
#include "run/domain/model_cells.h"
#include "run/pictures/cell_look.h"
#include "run/pictures/cell_picture.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// The values of a canvas in the cells of a model.
struct ModelLook : CellLook {
    ModelLook(const ModelCells& model, const Canvas& canvas, ValueRange range,
              const Palette& palette);

    double scale = 1;  ///< The size of the model, divided by its size without growth.

    /// Sets heights computed from a number. The height of a cell is the position of its number in
    /// `range`, 0 … 1, times `bump` times the longest side of the model.
    void raise(const ModelCells& model, const Field& number, ValueRange range, float bump);
    /// Returns the visible colour of cell k, which is at `place`.
    Colour colour_of(std::size_t k, const SurfacePlace& place) const {
        return colour(std::span(values).subspan(k * channels, channels), place);
    }
};

/// Draws pictures of a model. Data that later pictures need again is stored.
class ModelDrawer {
public:
    /// Throws std::bad_alloc.
    explicit ModelDrawer(std::shared_ptr<const ModelCells> model);

    /// Draws the model. `copies` are objects on the model, in the coordinates of drawn(). If null,
    /// there are no objects.
    Image draw(const ModelLook& look, const DrawOptions& options,
               const Instances* copies = nullptr);
    const DrawnMesh& drawn() const { return scene_.drawn(); }
    const ModelCells& model() const { return *model_; }
    const CellFilter& filter() const { return scene_.filter(); }

private:
    std::shared_ptr<const ModelCells> model_;
    Team team_;
    CellScene scene_;
};

}  // namespace cascade
