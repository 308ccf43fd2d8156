// Pictures of a simulation.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "run/script/picture_request.h"
#include "run/simulation/simulation.h"

#include <memory>
#include <optional>
#include <vector>

namespace cascade {

/// Values to be painted: one field through the palette, or red, green and blue. Pictures are
/// painted in binary32.
struct Canvas {
    std::vector<Field> fields;
    Field relief = {};  ///< Of a colour that has bumps: the number of their heights.
    bool is_colour() const { return fields.size() == 3; }
    /// What heights and the range are of; nullptr where there are colours alone.
    const Field* number() const;
};

class ModelDrawer;
struct ModelLook;

/// Computes what the request shows, for whatever stage the simulation has reached.
class Painter {
public:
    /// Checks `show` and the palette; faults of `show` go to `script.diagnostics`.
    static Result<Painter> create(Script& script, const PictureRequest& request);

    /// The values to paint now. Where the picture block names a stage that has not run, the default
    /// is computed, and `fell_back()` is true from then on. Of a volume they are a slice.
    Canvas canvas(const Simulation& simulation);
    /// The same of all cells, of a volume too, in the run's precision.
    Canvas values(const Simulation& simulation);
    bool fell_back() const { return fell_back_; }

    /// The canvas as an image, transparent outside of the mask and enlarged; where the domain lies
    /// on a surface, drawn on it. `range` overrides the automatic one.
    Image image(const Canvas& canvas, std::optional<ValueRange> range = {}) const;
    const PictureRequest& request() const { return request_; }
    /// From where pictures are taken from now on.
    void set_view(const View& view) { request_.view = view; }
    /// What the last canvas shows on its model.
    ModelLook look(const Canvas& canvas, std::optional<ValueRange> range = {}) const;

private:
    Image texture(const Canvas& canvas, std::optional<ValueRange> range) const;
    ValueRange range_of(const Canvas& canvas, std::optional<ValueRange> range) const;
    Image on_model(const Canvas& canvas, std::optional<ValueRange> range) const;
    std::optional<Formula> formula_for(std::uint32_t stage, std::uint32_t last_stage);

    Script* script_ = nullptr;
    PictureRequest request_;
    std::optional<ast::Expression> show_;
    const Palette* palette_ = nullptr;
    bool fell_back_ = false;
    std::shared_ptr<const ModelCells> model_;            ///< Of the last canvas; none on grids.
    mutable std::shared_ptr<const ModelDrawer> drawer_;  ///< Made when a picture is first drawn.
    Field outside_;  ///< Of the last canvas: NaN where there is no domain; empty without a mask.
};

/// One labelled picture of all species of all stages that have started.
Image draw_sheet(const Simulation& simulation, const PictureRequest& request);

}  // namespace cascade
