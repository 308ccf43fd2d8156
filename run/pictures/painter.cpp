// Checks --show once, when the painter is made. Evaluates it in the shown stage, and paints a
// plane, a slice, a surface or a model.
#include "run/pictures/painter.h"

#include "core/near_name.h"
#include "export/plane_maps.h"
#include "lang/check/check.h"
#include "lang/syntax/parse.h"
#include "run/domain/domain_mask.h"
#include "run/domain/metric_planes.h"
#include "run/pictures/body_picture.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/drawn_cells.h"
#include "run/pictures/picture_size.h"
#include "run/pictures/proportions.h"
#include "run/pictures/shown_field.h"
#include "run/pictures/plane_look.h"
#include "run/pictures/surface_picture.h"
#include "run/pictures/tissue_picture.h"
#include "run/simulation/finer_view.h"
#include "lang/syntax/picture_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade {

namespace {

/// Returns the last stage whose values formulas may read: the last started stage or, if no stage
/// after the shown stage has started, the shown stage.
std::uint32_t last_to_read(const Simulation& simulation, std::uint32_t stage) {
    std::uint32_t last = stage;
    while (last + 1 < simulation.domain().program->stages.size() &&
           simulation.state(last + 1).started) {
        ++last;
    }
    return last;
}

/// Returns a function that evaluates formulas in the shown stage.
EvaluateFormula evaluation_in(const Simulation& simulation) {
    return [&simulation](const Formula& formula) {
        return simulation.evaluate(formula, shown_stage(simulation));
    };
}

}  // namespace

const Field* Canvas::number() const {
    if (!is_colour()) return &fields[0];
    return relief.empty() ? nullptr : &relief;
}

Result<Painter> Painter::create(Script& script, const PictureRequest& request,
                                std::string_view option) {
    Painter painter;
    painter.script_ = &script;
    painter.request_ = request;
    painter.shows_body_ = draws_body(script, request);
    painter.palette_ = find_palette(request.palette);
    if (!painter.palette_) {
        std::vector<std::string> names;
        for (const Palette& palette : palettes()) names.emplace_back(palette.name);
        const std::string near = nearest_name(request.palette, names);
        return failure(fmt::format("there is no palette '{}'", request.palette),
                       near.empty() ? fmt::format("the palettes are {}", fmt::join(names, ", "))
                                    : fmt::format("did you mean '{}'?", near));
    }
    if (has_cells(script)) {
        auto file = picture_file(script);
        if (!file) return tl::unexpected(file.error());
        painter.file_shape_ = *std::move(file);
    }
    if (request.show.empty()) return painter;

    const SourceId source = script.sources.add(fmt::format("<{}>", option), request.show);
    painter.show_ = parse_expression(source, script.sources, script.tree, script.diagnostics);
    if (painter.show_) {
        check_view(script.tree, *painter.show_, script.final_stage(), script.stage_count() - 1,
                   *script.program, script.sources, script.diagnostics);
    }
    if (script.diagnostics.has_errors()) {
        return failure(fmt::format("the expression of {} is wrong", option));
    }
    return painter;
}

std::optional<Formula> Painter::formula(const Simulation& simulation) {
    const auto expression = show_ ? show_ : picture_expression(script_->tree);
    if (!expression) return std::nullopt;
    const std::uint32_t stage = shown_stage(simulation);
    // Other errors than a name without a value yet have been reported, so the diagnostics are
    // ignored.
    Diagnostics unspoken;
    return check_view(script_->tree, *expression, stage, last_to_read(simulation, stage),
                      *script_->program, script_->sources, unspoken);
}

std::vector<Field> Painter::evaluate(const Simulation& simulation,
                                     const EvaluateFormula& evaluate) {
    const std::uint32_t stage = shown_stage(simulation);
    const bool asked = show_ || picture_expression(script_->tree);
    const auto wanted = formula(simulation);
    if (!wanted) fell_back_ = fell_back_ || asked;
    return evaluate(wanted ? *wanted : simulation.domain().stage(stage).show);
}

Canvas Painter::values(const Simulation& simulation) {
    return {evaluate(simulation, evaluation_in(simulation))};
}

/// Records which domain and which kind of stage a canvas shows.
void Painter::look_at_domain(const Simulation& simulation) {
    model_ = simulation.domain().shared_model();
    shows_cells_ = simulation.state(shown_stage(simulation)).tissue() != nullptr;
    if (const DomainMask* mask = simulation.domain().inside()) {
        outside_ = as_shown(Field(PlaneLayout(simulation.domain().grid)), mask, request_);
    }
}

Canvas Painter::canvas(const Simulation& simulation) {
    look_at_domain(simulation);
    if (is_flat() && request_.size) {
        const PictureSize copy = copy_size(simulation.domain().grid, request_);
        Canvas plane = canvas_of_plane(simulation, std::max(copy.width, copy.height), false);
        plane.scales = scales_of_plane(simulation, request_.slice);
        return plane;
    }
    Canvas canvas = values(simulation);
    canvas.scales =
        is_flat() ? scales_of_plane(simulation, request_.slice) : scales_of_body(simulation);
    if (shows_cells_) return canvas_of_cells(simulation, std::move(canvas));
    if (shows_body_) return canvas_of_body(simulation, std::move(canvas));
    for (Field& field : canvas.fields) field = shown(std::move(field), request_);
    if (!is_plane()) canvas.material = material(simulation, evaluation_in(simulation));
    if (model_ && request_.bump != 0 && canvas.is_colour()) {
        const std::uint32_t stage = shown_stage(simulation);
        auto usual = simulation.evaluate(simulation.domain().stage(stage).show, stage);
        if (usual.size() == 1) canvas.relief = shown(std::move(usual[0]), request_);
    }
    return canvas;
}

MaterialFields Painter::material(const Simulation& simulation,
                                 const EvaluateFormula& evaluate) const {
    const std::uint32_t stage = shown_stage(simulation);
    MaterialFields fields =
        material_fields(*script_, evaluate, stage, last_to_read(simulation, stage));
    for (Field& field : fields.parts) {
        if (!field.empty()) field = shown(std::move(field), request_);
    }
    if (!fields.height.empty()) fields.height = shown(std::move(fields.height), request_);
    return fields;
}

Canvas Painter::map_canvas(const Simulation& simulation, std::int64_t texels) {
    look_at_domain(simulation);
    return canvas_of_plane(simulation, texels, true);
}

Canvas Painter::canvas_of_plane(const Simulation& simulation, std::int64_t texels,
                                bool has_material) {
    constexpr std::int64_t most_parts = 8, most_cells = std::int64_t{1} << 22;
    const Grid& grid = simulation.domain().grid;
    std::int64_t parts = std::clamp<std::int64_t>(texels / grid.longest_side(), 1, most_parts);
    while (parts > 1 && grid.cell_count() > most_cells / (parts * parts)) --parts;
    const auto finer = parts > 1 ? finer_view(simulation, parts) : nullptr;
    EvaluateFormula evaluation = evaluation_in(simulation);
    if (finer) {
        evaluation = [&](const Formula& formula) {
            return finer->evaluate(formula, shown_stage(simulation));
        };
    }
    Canvas canvas{evaluate(simulation, evaluation)};
    for (Field& field : canvas.fields) field = shown(std::move(field), request_);
    if (has_material) canvas.material = material(simulation, evaluation);
    if (finer) canvas.parts = parts;
    return canvas;
}

PlaneLook Painter::plane_look(const Canvas& canvas, std::optional<ValueRange> range) const {
    const PlaneLayout& layout = canvas.fields[0].layout();
    const Grid& grid = script_->program->domain.grid;
    FlatCells plane{layout.width, layout.height, grid.spacing / static_cast<double>(canvas.parts)};
    plane.repeats = sides_that_repeat(grid, request_.slice);
    if (!outside_.empty()) {
        for (std::int64_t j = 0; j < layout.height; ++j) {
            for (std::int64_t i = 0; i < layout.width; ++i) {
                plane.inside.push_back(std::isnan(outside_.at(i, j)) ? 0 : 1);
            }
        }
    }
    return PlaneLook(canvas, range_of(canvas, range), *palette_, std::move(plane));
}

ValueRange Painter::range_of(const Canvas& canvas, std::optional<ValueRange> range) const {
    if (request_.range) return *request_.range;
    if (range) return *range;
    const Field* number = canvas.number();
    return number != nullptr ? automatic_range(spread_of(*number)) : ValueRange();
}

Image Painter::texture(const Canvas& canvas, std::optional<ValueRange> range, Image earlier) const {
    const auto& fields = canvas.fields;
    Image image = canvas.is_colour()
                      ? paint(fields[0], fields[1], fields[2], std::move(earlier))
                      : paint(fields[0], range_of(canvas, range), *palette_, std::move(earlier));
    if (!outside_.empty()) clear_where_nan(image, outside_);
    return image;
}

/// Draws a smooth picture. If the picture consists of several copies, draws one of them.
Image Painter::smooth(const Canvas& canvas, std::optional<ValueRange> range) const {
    const PlaneLook look = plane_look(canvas, range);
    const PictureSize size = copy_size(script_->program->domain.grid, request_);
    Team team(hardware_threads());
    MaterialMaps maps = bake_plane(look.cells, look.painted(), {size.width, size.height}, team);
    Image image = std::move(maps.colour);
    for (const Colour& opacity : maps.opacity.pixels) image.alpha.push_back(opacity[0]);
    return image;
}

ModelLook Painter::look(const Canvas& canvas, std::optional<ValueRange> range) const {
    const ValueRange used = range_of(canvas, range);
    ModelLook look(*model_, canvas, used, *palette_);
    look.displaces = request_.displace;
    if (request_.bump != 0 && canvas.number() != nullptr) {
        look.raise(*model_, *canvas.number(), used, request_.bump);
    }
    return look;
}

DrawOptions Painter::draw_options() const {
    DrawOptions options;
    const PictureSize size = request_.size.value_or(usual_size);
    options.width = size.width;
    options.height = size.height;
    options.quality = request_.quality;
    options.lighting = request_.lighting;
    options.ground = request_.ground;
    options.background = request_.background;
    options.report = report_;
    if (width_) {
        options.height = std::max<std::int64_t>(1, *width_ * options.height / options.width);
        options.width = *width_;
    }
    options.width *= request_.scale;
    options.height *= request_.scale;
    options.view = request_.view;
    if (request_.fov) {
        const double half = static_cast<double>(*request_.fov) / 2 * std::numbers::pi / 180;
        options.view.half_field = static_cast<float>(std::tan(half));
    }
    return options;
}

Image Painter::on_model(const Canvas& canvas, std::optional<ValueRange> range) {
    if (!drawer_) drawer_ = std::make_shared<ModelDrawer>(model_);
    DrawOptions options = draw_options();
    options.view.up = {0, 1, 0};  // Models have been turned upright when they were read.
    return drawer_->draw(look(canvas, range), options);
}

bool Painter::is_plane() const {
    return !model_ && (!script_->program->domain.surface || request_.flat);
}

/// Adds the body to the canvas, and replaces each field by its values at the points of the body. If
/// the formula of the body reads a stage that has not run, the body has no points.
Canvas Painter::canvas_of_body(const Simulation& simulation, Canvas values) {
    const std::uint32_t stage = shown_stage(simulation);
    const auto inside = setting_values(*script_, "body", evaluation_in(simulation), stage,
                                       last_to_read(simulation, stage));
    const Boundaries boundary = simulation.domain().grid.boundary;
    values.body = inside.empty() ? std::make_shared<const SurfaceMesh>()
                                 : body_of(inside[0], simulation.domain().inside(), boundary);
    for (Field& field : values.fields) field = at_points(field, *values.body, boundary);
    return values;
}

Image Painter::of_body(const Canvas& canvas, std::optional<ValueRange> range) const {
    DrawOptions options = draw_options();
    options.view.up = {0, 1, 0};
    return draw_body(canvas.body, colours_of_row(canvas, range), options);
}

/// Adds the crawling cells to the canvas, and puts its values in the order of the cells' numbers.
Canvas Painter::canvas_of_cells(const Simulation& simulation, Canvas values) {
    const std::uint32_t stage = shown_stage(simulation);
    const Tissue& tissue = *simulation.state(stage).tissue();
    for (Field& field : values.fields) field = row_of_cells(field, tissue);
    values.cells =
        std::make_shared<const DrawnCells>(drawn_cells(*script_, simulation, stage, file_shape_));
    return values;
}

std::vector<Colour> Painter::colours_of_row(const Canvas& canvas,
                                            std::optional<ValueRange> range) const {
    const ValueRange used = range_of(canvas, range);
    const std::size_t count = canvas.body ? canvas.body->points.size() : canvas.cells->count;
    std::vector<Colour> colours;
    for (std::size_t cell = 0; cell < count; ++cell) {
        const auto value = [&](std::size_t channel) {
            return canvas.fields[channel].plane().row(0)[cell];
        };
        const auto shown = [](float part) { return std::clamp(part, 0.0F, 1.0F); };
        colours.push_back(canvas.is_colour()
                              ? Colour{shown(value(0)), shown(value(1)), shown(value(2))}
                              : colour_at(*palette_, position_in(used, value(0))));
    }
    return colours;
}

Image Painter::with_cells(const Canvas& canvas, std::optional<ValueRange> range) {
    DrawOptions options = draw_options();
    options.view.up = {0, 1, 0};
    if (canvas.cells->coat && !drawer_) drawer_ = std::make_shared<ModelDrawer>(model_);
    return draw_cells(*canvas.cells, colours_of_row(canvas, range), model_.get(), drawer_.get(),
                      options);
}

bool Painter::has_pixel_per_cell(const Canvas& canvas) const {
    return !canvas.cells && !canvas.body && has_square_cells() && request_.scale == 1 &&
           request_.copies == PictureCopies() && canvas.scales[0] == canvas.scales[1];
}

Image Painter::image(const Canvas& canvas, std::optional<ValueRange> range, Image earlier) {
    // Images of other kinds cannot reuse this memory.
    if (!has_pixel_per_cell(canvas)) earlier = {};
    if (canvas.cells) return with_cells(canvas, range);
    if (canvas.body) return of_body(canvas, range);
    if (model_) return on_model(canvas, range);
    if (is_plane()) {
        Image copy = request_.size
                         ? smooth(canvas, range)
                         : enlarge(texture(canvas, range, std::move(earlier)), request_.scale);
        copy = in_proportion(std::move(copy), canvas.scales);
        if (request_.copies == PictureCopies()) return copy;
        return repeated(copy, request_.copies.across, request_.copies.down);
    }
    Team team(hardware_threads());
    return draw_on_surface(function_of(*script_->program->domain.surface), texture(canvas, range),
                           grid_material(canvas, script_->program->domain), draw_options(), team);
}

Image Painter::image_beside_cells(const Canvas& canvas, std::optional<ValueRange> range) {
    if (canvas.cells || canvas.body || !is_plane()) return image(canvas, range);
    const PlaneLayout& layout = canvas.fields[0].layout();
    const auto longest = static_cast<double>(std::max(layout.width, layout.height));
    DrawnCells nobody;
    nobody.extent = {static_cast<double>(layout.width) / longest,
                     static_cast<double>(layout.height) / longest, 0};
    nobody.floor = std::make_shared<const Image>(request_.size ? smooth(canvas, range)
                                                               : texture(canvas, range));
    DrawOptions options = draw_options();
    options.view.up = {0, 1, 0};
    return draw_cells(nobody, {}, nullptr, nullptr, options);
}

std::optional<Painting> Painter::painting(const Canvas& canvas,
                                          std::optional<ValueRange> range) const {
    const bool is_plain = has_pixel_per_cell(canvas) && outside_.empty() && !canvas.is_colour();
    if (!is_plain) return std::nullopt;
    return Painting{canvas.fields[0], range_of(canvas, range), *palette_};
}

Image draw_sheet(const Simulation& simulation, const PictureRequest& request) {
    const Program& program = *simulation.domain().program;
    const DomainMask* const mask = simulation.domain().inside();
    const Palette& palette = *find_palette(request.palette);
    std::vector<Panel> panels;
    std::size_t columns = 1;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (!simulation.state(k).started) continue;
        const System& system = program.system_of(k);
        std::size_t in_stage = 0;
        for (const ItemId item : system.species()) {
            const Field field = as_shown(simulation.field(k, item), mask, request);
            const ValueRange range = request.range.value_or(automatic_range(spread_of(field)));
            Image image = paint(field, range, palette);
            if (mask != nullptr) clear_where_nan(image, field);
            panels.push_back({fmt::format("{}.{} {:.4g}..{:.4g}", program.stages[k].name,
                                          system.item_name(item), range.low, range.high),
                              enlarge(std::move(image), request.scale)});
            ++in_stage;
        }
        columns = std::max(columns, in_stage);
    }
    return make_sheet(panels, static_cast<int>(columns));
}

}  // namespace cascade
