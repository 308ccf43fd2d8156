// Pictures of a simulation.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "render/draw.h"
#include "run/pictures/material.h"
#include "run/script/picture_request.h"
#include "run/simulation/simulation.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

struct DrawnCells;
struct FileShape;
struct SurfaceMesh;

/// Values to paint, in binary32: one field for the palette, or red, green and blue.
struct Canvas {
    std::vector<Field> fields;
    Field relief = {};             ///< For a colour with bumps: the number of the heights.
    MaterialFields material = {};  ///< For a model, and for map_canvas().
    std::int64_t parts = 1;        ///< Per cell along each axis: more for maps and smooth pictures.
    /// For a stage of crawling cells: the fields are in their order. Otherwise null.
    std::shared_ptr<const DrawnCells> cells = nullptr;
    /// For a volume drawn as a body: its surface, in script lengths. The fields are at its points,
    /// in one row. Otherwise null. Without points it is empty.
    std::shared_ptr<const SurfaceMesh> body = nullptr;
    bool is_colour() const { return fields.size() == 3; }
    /// The number that heights and range refer to. Null if there are only colours.
    const Field* number() const;
};

/// The planes of a canvas besides `fields`, possibly empty: relief, height and material.
template <typename AnyCanvas>
auto extra_planes(AnyCanvas& canvas) {
    std::array<decltype(&canvas.relief), 2 + material_parts> planes{&canvas.relief,
                                                                    &canvas.material.height};
    for (std::size_t k = 0; k < material_parts; ++k) planes[2 + k] = &canvas.material.parts[k];
    return planes;
}

class ModelDrawer;
struct ModelLook;
struct PlaneLook;

/// Computes and paints the requested picture at any stage of a simulation.
class Painter {
public:
    /// Checks `show`, given by `option`, and the palette. Errors in `show` go to
    /// `script.diagnostics`.
    static Result<Painter> create(Script& script, const PictureRequest& request,
                                  std::string_view option = "--show");

    /// The values to paint now: of a slice or a body for a volume. If the picture block names a
    /// stage that has not run, uses the default picture, and `fell_back()` is true from then on.
    Canvas canvas(const Simulation& simulation);
    /// The same for all cells, also of a volume, in the run's precision.
    Canvas values(const Simulation& simulation);
    bool fell_back() const { return fell_back_; }
    /// The values of a plane for maps whose longer side has this many texels, with the material.
    /// Divides cells larger than texels, at most into 8 × 8, and computes formulas in the parts, so
    /// that thresholds have smooth outlines. Canvases of smooth pictures are made in this way, too,
    /// without a material.
    Canvas map_canvas(const Simulation& simulation, std::int64_t texels);

    /// The expression of --show or the picture block for the stage shown. Empty for the default.
    std::optional<Formula> formula(const Simulation& simulation);

    /// The canvas as an image, enlarged or smooth, and transparent outside of the mask, drawn on
    /// the surface if the domain has one. `range` overrides the automatic range. The image may be
    /// made in the memory of an earlier one.
    Image image(const Canvas& canvas, std::optional<ValueRange> range = {}, Image earlier = {});
    /// image() for a film that also shows crawling cells, in the size of those frames. A plane, or
    /// a slice, is drawn as the floor below the cells.
    Image image_beside_cells(const Canvas& canvas, std::optional<ValueRange> range);
    /// The painting that image() makes, if it does no more than paint: there is a pixel for each
    /// cell, and no mask.
    std::optional<Painting> painting(const Canvas& canvas,
                                     std::optional<ValueRange> range = {}) const;
    /// True if the last canvas appears as the plane it is, or as the texture of a surface.
    bool is_flat() const { return !shows_cells_ && !shows_body_ && is_plane(); }
    /// True if, moreover, each of its cells becomes a square of pixels. Then image() may be called
    /// from several threads at once, and uses one.
    bool has_square_cells() const { return is_flat() && !request_.size; }
    const PictureRequest& request() const { return request_; }
    const Palette& palette() const { return *palette_; }
    /// Sets the view of later pictures.
    void set_view(const View& view) { request_.view = view; }
    /// Sets the width, in pixels, of later pictures of surfaces and of crawling cells.
    void set_width(std::int64_t width) { width_ = width; }
    /// Called while later pictures of surfaces are drawn with the part that is done, 0 … 1. If it
    /// returns false, the picture stays unfinished.
    void set_report(std::function<bool(double)> report) { report_ = std::move(report); }
    /// Sets the slice of later canvases.
    void set_slice(const Slice& slice) { request_.slice = slice; }
    /// The colours of a canvas of crawling cells, in the order of their numbers, or of a body at
    /// its points.
    std::vector<Colour> colours_of_row(const Canvas& canvas,
                                       std::optional<ValueRange> range = {}) const;
    /// The values of the last canvas at the cells of its model.
    ModelLook look(const Canvas& canvas, std::optional<ValueRange> range = {}) const;
    /// The values of the last canvas, of a plane or a slice.
    PlaneLook plane_look(const Canvas& canvas, std::optional<ValueRange> range = {}) const;

    /// The range of the palette: --range, or `range`, or the automatic one.
    ValueRange range_of(const Canvas& canvas, std::optional<ValueRange> range = {}) const;

private:
    void look_at_domain(const Simulation& simulation);
    Canvas canvas_of_plane(const Simulation& simulation, std::int64_t texels, bool has_material);
    /// True if fields appear as planes.
    bool is_plane() const;
    /// True if the image has exactly one pixel for each cell.
    bool has_pixel_per_cell(const Canvas& canvas) const;
    Image texture(const Canvas& canvas, std::optional<ValueRange> range, Image earlier = {}) const;
    Image smooth(const Canvas& canvas, std::optional<ValueRange> range) const;
    std::vector<Field> evaluate(const Simulation& simulation, const EvaluateFormula& evaluate);
    MaterialFields material(const Simulation& simulation, const EvaluateFormula& evaluate) const;
    DrawOptions draw_options() const;
    Image on_model(const Canvas& canvas, std::optional<ValueRange> range);
    Canvas canvas_of_body(const Simulation& simulation, Canvas values);
    Image of_body(const Canvas& canvas, std::optional<ValueRange> range) const;
    Canvas canvas_of_cells(const Simulation& simulation, Canvas values);
    Image with_cells(const Canvas& canvas, std::optional<ValueRange> range);

    Script* script_ = nullptr;
    PictureRequest request_;
    std::optional<ast::Expression> show_;
    const Palette* palette_ = nullptr;
    bool fell_back_ = false;
    std::shared_ptr<const FileShape> file_shape_;  ///< For the file in the picture block, or null.
    std::shared_ptr<const ModelCells> model_;      ///< The last canvas's. Null on grids.
    std::shared_ptr<ModelDrawer> drawer_;          ///< Made with the first picture.
    std::optional<std::int64_t> width_;            ///< Otherwise the default.
    std::function<bool(double)> report_;
    bool shows_cells_ = false;  ///< The last canvas was of crawling cells.
    bool shows_body_ = false;   ///< Volumes are drawn as bodies.
    Field outside_;  ///< For the last canvas: NaN outside of the domain. Empty without a mask.
};

/// One labelled picture of all species of all started stages.
Image draw_sheet(const Simulation& simulation, const PictureRequest& request);

}  // namespace cascade
