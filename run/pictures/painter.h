// Makes the pictures of a simulation.
#pragma once

#include "core/result.h"
#include "picture/image.h"
#include "render/draw.h"
#include "run/pictures/material.h"
#include "run/pictures/proportions.h"
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

/// The values to paint, in binary32: one field for the palette, or red, green and blue.
struct Canvas {
    std::vector<Field> fields;
    /// For a picture of colours with bumps, the number from which the heights are computed.
    Field relief = {};
    MaterialFields material = {};  ///< Has values for models and in the result of map_canvas().
    /// The lengths of a cell of a plane or slice, across and down, divided by the spacing, or the
    /// result of scales_of_body(). They differ from 1 in a domain that grows.
    PlaneScales scales{1, 1};
    /// The number of parts into which a cell is divided along each axis. Above 1 only in maps and
    /// smooth pictures.
    std::int64_t parts = 1;
    /// The cells of a stage of crawling cells, in the order of the values in the fields. Null for
    /// other stages.
    std::shared_ptr<const DrawnCells> cells = nullptr;
    /// The surface of a volume that is drawn as a body, in the script's unit of length. Each field
    /// is then one row with the values at the points of the surface. The surface has no points if
    /// the body is empty. Null if no body is drawn.
    std::shared_ptr<const SurfaceMesh> body = nullptr;
    bool is_colour() const { return fields.size() == 3; }
    /// Returns the number to which heights and the range refer. Returns null if the canvas contains
    /// only colours.
    const Field* number() const;
};

/// Returns all planes of a canvas besides `fields`: relief, height and material. Some may be empty.
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

/// Computes and paints the requested picture at any moment of a simulation.
class Painter {
public:
    /// Checks the expression `show` of the option named `option`, and the palette. Errors in `show`
    /// are added to `script.diagnostics`.
    static Result<Painter> create(Script& script, const PictureRequest& request,
                                  std::string_view option = "--show");

    /// Computes the values to paint now. For a volume these are the values of a slice or a body. If
    /// the picture block reads a stage that has not run, the default picture is used, and from then
    /// on fell_back() returns true.
    Canvas canvas(const Simulation& simulation);
    /// Computes the values of all cells in the run's precision. In a volume, these are the cells of
    /// all slices.
    Canvas values(const Simulation& simulation);
    bool fell_back() const { return fell_back_; }
    /// Computes the values of a plane, with the material, for maps whose longer side has `texels`
    /// texels. A cell that is larger than a texel is divided into up to 8 × 8 parts. Formulas are
    /// evaluated in each part, so that thresholds have smooth outlines. Canvases of smooth pictures
    /// are made in the same way, but without the material.
    Canvas map_canvas(const Simulation& simulation, std::int64_t texels);

    /// Returns the expression of --show or, if it is missing, of the picture block, for the shown
    /// stage. Returns an empty optional for the default picture.
    std::optional<Formula> formula(const Simulation& simulation);

    /// Paints a canvas. The image is enlarged or smooth as requested, and transparent outside the
    /// mask. If the domain has a surface, the image is drawn on it. `range` replaces the automatic
    /// range. The image may reuse the memory of `earlier`.
    Image image(const Canvas& canvas, std::optional<ValueRange> range = {}, Image earlier = {});
    /// Paints a canvas as image() does, for a film that also shows crawling cells. The image has
    /// the size of frames with cells. A plane or slice is drawn as the floor below the cells.
    Image image_beside_cells(const Canvas& canvas, std::optional<ValueRange> range);
    /// Returns the data with which another program paints the canvas, with one pixel for each cell
    /// and without a mask. Returns an empty optional if image() would draw more than that.
    std::optional<Painting> painting(const Canvas& canvas,
                                     std::optional<ValueRange> range = {}) const;
    /// Whether the last canvas is shown as a plane, or as the texture of a surface.
    bool is_flat() const { return !shows_cells_ && !shows_body_ && is_plane(); }
    /// Whether the last canvas is shown as a plane on which each cell is a square of pixels. If
    /// true, several threads may call image() at the same time, and each call uses one thread.
    bool has_square_cells() const { return is_flat() && !request_.size; }
    const PictureRequest& request() const { return request_; }
    const Palette& palette() const { return *palette_; }
    /// Sets the direction and distance of the viewer for later pictures.
    void set_view(const View& view) { request_.view = view; }
    /// Sets the width, in pixels, of later pictures of surfaces and of crawling cells.
    void set_width(std::int64_t width) { width_ = width; }
    /// Sets a function that is called while later pictures of surfaces are drawn. Its argument is
    /// the fraction that is complete. If the function returns false, the picture remains
    /// incomplete.
    void set_report(std::function<bool(double)> report) { report_ = std::move(report); }
    /// Sets the slice for later canvases.
    void set_slice(const Slice& slice) { request_.slice = slice; }
    /// Returns the colours of the points of a body or, for a canvas of crawling cells, the colours
    /// of the cells in the order of their numbers.
    std::vector<Colour> colours_of_row(const Canvas& canvas,
                                       std::optional<ValueRange> range = {}) const;
    /// Returns the values of the last canvas in the cells of its model.
    ModelLook look(const Canvas& canvas, std::optional<ValueRange> range = {}) const;
    /// Returns the values of the last canvas, which must be of a plane or slice.
    PlaneLook plane_look(const Canvas& canvas, std::optional<ValueRange> range = {}) const;

    /// Returns the range of values for the palette: --range if it is given, otherwise `range` if it
    /// is given, and otherwise the automatic range.
    ValueRange range_of(const Canvas& canvas, std::optional<ValueRange> range = {}) const;

private:
    void look_at_domain(const Simulation& simulation);
    Canvas canvas_of_plane(const Simulation& simulation, std::int64_t texels, bool has_material);
    /// Whether the fields of the last canvas are shown as planes.
    bool is_plane() const;
    /// Whether the image has exactly one pixel for each cell.
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
    /// The shape from the file that the picture block names. Null if the picture block names no
    /// file.
    std::shared_ptr<const FileShape> file_shape_;
    std::shared_ptr<const ModelCells> model_;  ///< The model of the last canvas. Null on grids.
    std::shared_ptr<ModelDrawer> drawer_;      ///< Made when the first picture of a model is drawn.
    std::optional<std::int64_t> width_;        ///< Empty: the pictures have the default width.
    std::function<bool(double)> report_;
    bool shows_cells_ = false;  ///< Whether the last canvas shows crawling cells.
    bool shows_body_ = false;   ///< Whether volumes are drawn as bodies.
    /// A mask for the last canvas, which is NaN outside the domain. Empty if the domain has no
    /// mask.
    Field outside_;
};

/// Draws all species of all started stages in one labelled picture.
Image draw_sheet(const Simulation& simulation, const PictureRequest& request);

}  // namespace cascade
