// What a picture shows and how it is drawn.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "picture/slice.h"
#include "render/camera.h"
#include "run/simulation.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Options of `cascade run` that decide a picture's looks. They travel inside the picture.
struct PictureRequest {
    std::string show;                  ///< An expression; "" is the picture block or the default.
    std::string palette = "grey";
    std::optional<ValueRange> range;   ///< Empty: from the values.
    int scale = 1;                     ///< Pixels per cell.
    int depth = 8;                     ///< Bits: 8 or 16.
    bool space_time = false;           ///< 1-D grids: a row of pixels per interval.
    Slice slice;                       ///< 3-D grids: what a picture shows of them.
    bool flat = false;                 ///< Of a surface: the texture alone.
    View view;                         ///< Of a surface: from where it is seen.
    /// Of a model: how far the largest number stands out before the smallest one, in sides of the
    /// model, −1 … 1.
    float bump = 0;

    /// Is the surface seen from another place than usual?
    bool is_turned() const;
    PngDepth png_depth() const { return depth == 16 ? PngDepth::sixteen : PngDepth::eight; }
};

std::string to_json(const PictureRequest& request);
Result<PictureRequest> picture_request_from_json(const std::string& json);

/// Values to be painted: one field through the palette, or red, green and blue. Pictures are painted
/// in binary32.
struct Canvas {
    std::vector<Field> fields;
    Field relief = {};   ///< Of a colour that has bumps: the number of their heights.
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

    /// The canvas as an image, transparent outside of the mask and enlarged; where the domain lies on a surface, drawn on it. `range`
    /// overrides the automatic one.
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
    std::shared_ptr<const ModelCells> model_;          ///< Of the last canvas; none on grids.
    mutable std::shared_ptr<const ModelDrawer> drawer_;  ///< Made when a picture is first drawn.
    Field outside_;  ///< Of the last canvas: NaN where there is no domain; empty without a mask.
};

/// One labelled picture of all species of all stages that have started.
Image draw_sheet(const Simulation& simulation, const PictureRequest& request);

}  // namespace cascade
