// Sizes and directions of cells are formulas of the picture block. They are evaluated in all cells
// together.
#include "run/pictures/drawn_cells.h"

#include "core/check.h"
#include "core/parallel.h"
#include "lang/check/check.h"
#include "lang/check/picture_shape.h"
#include "lang/program/stage_kinds.h"
#include "run/pictures/model_picture.h"
#include "run/simulation/tissue_stage.h"
#include "tissue/sense_kernel.h"
#include "tissue/tissue.h"
#include "lang/syntax/picture_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace cascade {

namespace {

/// The longest edge of facets. It is so long that it has no effect, because facets only have to
/// follow the shape.
constexpr double longest_facet = 2 * largest_of_shape;

/// The numeric settings of the picture block that apply to every shape.
struct Measure {
    enum Kind : std::size_t { width, length, height, tilt };
};
constexpr std::array<std::string_view, 4> measure_names{"width", "length", "height", "tilt"};

/// Returns the values of numeric settings of the picture block, in the order of the cells' numbers.
/// For a missing setting, returns no values.
std::vector<std::vector<double>> numbers_of(Script& script, const Simulation& simulation,
                                            std::uint32_t stage,
                                            std::span<const std::string> names) {
    std::vector<Formula> formulas;
    std::vector<std::size_t> which;
    for (std::size_t k = 0; k < names.size(); ++k) {
        const auto expression = picture_expression(script.tree, names[k]);
        if (!expression) continue;
        // The same errors were reported when the script was loaded, so the diagnostics are ignored.
        Diagnostics unspoken;
        auto formula = check_view(script.tree, *expression, stage, stage, *script.program,
                                  script.sources, unspoken);
        if (!formula || formula->nodes.back().type != ValueType::number) continue;
        formulas.push_back(std::move(*formula));
        which.push_back(k);
    }
    std::vector<std::vector<double>> numbers(names.size());
    if (formulas.empty()) return numbers;
    std::vector<const Formula*> each;
    for (const Formula& formula : formulas) each.push_back(&formula);
    const std::vector<Field> values = simulation.evaluate(each, stage);
    const Tissue& tissue = *simulation.state(stage).tissue();
    for (std::size_t k = 0; k < which.size(); ++k) {
        numbers[which[k]] = number_order(values[k], tissue);
    }
    return numbers;
}

/// Computes the colours of a body's points from a canvas with a colour for each cell of the grid.
std::vector<Colour> colours_on(const SurfaceMesh& body, const Canvas& canvas, Boundaries boundary) {
    std::array<PlaceValue, 3> channels;
    for (std::size_t k = 0; k < channels.size(); ++k) {
        channels[k] = of_grid(canvas.fields[k], boundary);
    }
    std::vector<Colour> colours;
    NearPlace near;
    for (const Vector3d& point : body.points) {
        near.position = point;
        Colour& colour = colours.emplace_back();
        for (std::size_t k = 0; k < channels.size(); ++k) {
            colour[k] = static_cast<float>(std::clamp(channels[k](near), 0.0, 1.0));
        }
        const auto is_nan = [](float part) { return std::isnan(part); };
        if (std::ranges::any_of(colour, is_nan)) colour = colour_of_nan;
    }
    return colours;
}

/// Sets the colour or the coat of the surface below the cells if the script has one.
void take_skin(Script& script, const Simulation& simulation, std::uint32_t stage,
               DrawnCells& drawn) {
    const auto expression = picture_expression(script.tree, "skin");
    if (!expression) return;
    const Program& program = *script.program;
    const auto of_fields = stage_of_fields_before(program, stage);
    const std::uint32_t read = of_fields.value_or(stage);
    Diagnostics unspoken;
    const auto formula =
        check_view(script.tree, *expression, read, stage, program, script.sources, unspoken);
    if (!formula || formula->nodes.back().type != ValueType::colour) return;
    Canvas canvas{simulation.evaluate(*formula, read)};
    const SimulationDomain& domain = simulation.domain();
    const Grid& grid = domain.grid;
    if (of_fields && domain.model) {
        drawn.coat = std::make_shared<const ModelLook>(*domain.model->cells, canvas, ValueRange(),
                                                       palettes()[0]);
    } else if (of_fields && grid.depth == 1) {
        for (Field& field : canvas.fields) {
            if (field.precision() != Precision::single) field = field.converted(Precision::single);
        }
        drawn.floor = std::make_shared<const Image>(
            paint(canvas.fields[0], canvas.fields[1], canvas.fields[2]));
    } else if (of_fields && drawn.body) {
        drawn.body_colours = colours_on(*drawn.body, canvas, grid.boundary);
    }
    for (std::size_t k = 0; k < drawn.skin.size(); ++k) {
        drawn.skin[k] = static_cast<float>(std::clamp(canvas.fields[k].number_at(0, 0), 0.0, 1.0));
    }
}

/// Returns a rotation about the x axis, from y towards z.
Quaternion leaning(double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    return {std::cos(half), std::sin(half), 0, 0};
}

/// The shapes of all cells, and the reasons why some shapes cannot be drawn.
struct CellShapes {
    SharedShapes shared;
    /// For each shape, the reason why it cannot be drawn. Empty if the shape can be drawn.
    std::vector<std::string> faults;
};

CellShapes shapes_of(const ShapeForm& form, std::vector<QuantityValues> values, std::size_t count) {
    CellShapes shapes{share_shapes(form, values, count), {}};
    for (const ShapeValues& each : shapes.shared.shapes) {
        shapes.faults.push_back(fault_of(form, each));
    }
    return shapes;
}

/// Writes the message about a cell whose shape cannot be drawn.
std::string fault_message(const ShapeForm& form, const CellShapes& shapes,
                          std::span<const QuantityValues> values, std::size_t cell,
                          std::uint32_t number) {
    const std::uint32_t shape = shapes.shared.of_cells[cell];
    std::string with;
    for (const QuantityValues& each : values) {
        const std::string& name = form.quantities[each.quantity].name;
        const double value = shape == SharedShapes::none
                                 ? each.of_cells[cell]
                                 : shapes.shared.shapes[shape][each.quantity.index()];
        with += fmt::format("{}{} = {:.4g}", with.empty() ? "" : ", ", name, value);
    }
    return fmt::format("the shape '{}' of cell {}{} {}", form.name, number,
                       with.empty() ? "" : " with " + with,
                       shape == SharedShapes::none ? "is not finite" : shapes.faults[shape]);
}

}  // namespace

std::vector<double> number_order(const Field& field, const Tissue& tissue) {
    return field.visit([&](const auto& plane) {
        std::vector<double> values;
        values.reserve(tissue.count());
        for (const std::uint32_t cell : tissue.by_number()) {
            values.push_back(static_cast<double>(plane.origin()[tissue.element(cell)]));
        }
        return values;
    });
}

Field row_of_cells(const Field& field, const Tissue& tissue) {
    std::vector<double> values = number_order(field, tissue);
    if (values.empty()) values.push_back(NAN);
    Plane<float> row(PlaneLayout(Grid{static_cast<std::int64_t>(values.size()), 1}));
    std::ranges::transform(values, row.row(0),
                           [](double value) { return static_cast<float>(value); });
    return Field(std::move(row));
}

PlacedFrames frames_of(const Simulation& simulation, std::uint32_t stage) {
    const StageState& state = simulation.state(stage);
    const Tissue& tissue = *state.tissue();
    const CellRules& rules = *simulation.domain().program->system_of(stage).cells;
    const auto values = [&](ItemId first, std::size_t k) {
        return number_order(state.field(ItemId(first.index() + k)), tissue);
    };
    const std::array place{values(rules.place, 0), values(rules.place, 1), values(rules.place, 2)};
    const std::array frame{values(rules.frame, 0), values(rules.frame, 1), values(rules.frame, 2),
                           values(rules.frame, 3)};
    PlacedFrames frames;
    frames.radii = values(rules.radius, 0);
    for (std::size_t k = 0; k < tissue.count(); ++k) {
        frames.places.push_back({place[0][k], place[1][k], place[2][k]});
        frames.turns.push_back(of_length_1({frame[0][k], frame[1][k], frame[2][k], frame[3][k]}));
    }
    return frames;
}

Result<std::shared_ptr<const FileShape>> picture_file(Script& script) {
    const PictureShape shape = picture_shape(script.tree, script.sources);
    if (shape.path.empty()) return nullptr;
    auto made = read_shape(script, shape.path);
    if (made) return std::make_shared<const FileShape>(*std::move(made));
    script.diagnostics.error(shape.span, made.error().message, made.error().hint);
    return failure("the shape of the picture cannot be read");
}

namespace {

/// Sets the shape: from a file or, if no file can be read, by the formulas that the picture block
/// names.
void take_shape(Script& script, std::shared_ptr<const FileShape> file, DrawnCells& drawn) {
    PictureShape shape = picture_shape(script.tree, script.sources);
    drawn.detail = shape.detail;
    drawn.file = std::move(file);
    if (!shape.path.empty() && !drawn.file) {
        auto made = read_shape(script, shape.path);
        if (made) drawn.file = std::make_shared<const FileShape>(*std::move(made));
    }
    drawn.form = shape.form ? *std::move(shape.form) : library_shape(usual_shape);
}

/// The measures of all cells. There is a list for each member of Measure, and a list for each
/// quantity of the shape.
struct MeasuredCells {
    std::vector<std::vector<double>> measures;
    std::vector<QuantityValues> quantities;

    double operator()(Measure::Kind which, std::size_t cell, double otherwise) const {
        return measures[which].empty() ? otherwise : measures[which][cell];
    }
};

MeasuredCells measured_cells(Script& script, const Simulation& simulation, std::uint32_t stage,
                             const ShapeForm& form) {
    std::vector<std::string> names(measure_names.begin(), measure_names.end());
    std::vector<ItemId> quantities;
    for (const ItemId item : form.quantities.ids()) {
        if (item.index() < ShapeForm::known_count) continue;
        quantities.push_back(item);
        names.push_back(form.quantities[item].name);
    }
    MeasuredCells measured{numbers_of(script, simulation, stage, names), {}};
    for (std::size_t k = 0; k < quantities.size(); ++k) {
        std::vector<double>& of_cells = measured.measures[measure_names.size() + k];
        if (!of_cells.empty()) measured.quantities.push_back({quantities[k], std::move(of_cells)});
    }
    return measured;
}

/// Returns the position and size of a cell. Returns an empty optional if a side of the cell is not
/// above 0 or not finite. `model` is null if the shape does not come from a file.
std::optional<Placement> placement_of(const PlacedFrames& frames, std::size_t k,
                                      const MeasuredCells& measure, const FileShape* model) {
    const double wide = measure(Measure::width, k, 2 * frames.radii[k]);
    const double high =
        measure(Measure::height, k, model != nullptr ? wide * model->height : frames.radii[k]);
    const double length =
        measure(Measure::length, k, model != nullptr ? wide * model->length : wide);
    for (const double size : {wide / 2, high, length / 2}) {
        if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
    }
    Placement placement;
    placement.scale = {wide / 2, high, length / 2};
    placement.place = frames.places[k];
    placement.turn = frames.turns[k];
    const double angle = measure(Measure::tilt, k, 0);
    if (std::isfinite(angle)) placement.turn = placement.turn * leaning(angle);
    return placement;
}

Vector3d extent_in_longest_sides(const Grid& grid) {
    const auto longest = static_cast<double>(grid.longest_side());
    return {static_cast<double>(grid.width) / longest, static_cast<double>(grid.height) / longest,
            grid.depth > 1 ? static_cast<double>(grid.depth) / longest : 0};
}

}  // namespace

DrawnCells drawn_cells(Script& script, const Simulation& simulation, std::uint32_t stage,
                       std::shared_ptr<const FileShape> file) {
    const StageState& state = simulation.state(stage);
    CHECK(state.tissue(), "the stage is one of cells that crawl");
    const Tissue& tissue = *state.tissue();
    const PlacedFrames frames = frames_of(simulation, stage);
    DrawnCells placed;
    take_shape(script, std::move(file), placed);
    const MeasuredCells measured = measured_cells(script, simulation, stage, placed.form);
    CellShapes shapes = shapes_of(placed.form, measured.quantities, tissue.count());
    std::size_t faulty = 0;
    placed.count = tissue.count();
    placed.extent = extent_in_longest_sides(simulation.domain().grid);
    placed.body = body_under_cells(simulation.state(stage));
    take_skin(script, simulation, stage, placed);
    if (placed.body && placed.body_colours.empty()) {
        placed.body_colours.assign(placed.body->points.size(), placed.skin);
    }
    for (std::size_t k = 0; k < tissue.count(); ++k) {
        std::optional<Placement> placement = placement_of(frames, k, measured, placed.file.get());
        if (!placement) continue;
        const std::uint32_t of_cell = shapes.shared.of_cells[k];
        if (of_cell == SharedShapes::none || !shapes.faults[of_cell].empty()) {
            if (faulty++ == 0) {
                placed.fault = fault_message(placed.form, shapes, measured.quantities, k,
                                             tissue.numbers()[tissue.by_number()[k]]);
            }
            continue;
        }
        placement->mesh = of_cell;
        placed.placements.push_back(*placement);
        placed.cells.push_back(k);
    }
    if (faulty > 0) {
        placed.fault =
            fmt::format("{} of {} cells are not drawn: {}", faulty, tissue.count(), placed.fault);
    }
    placed.shapes = std::move(shapes.shared.shapes);
    return placed;
}

namespace {

/// At level n, facets deviate by at most 2^-n from a shape of the default size.
constexpr int coarsest_level = 2, finest_level = 8;

int level_of(const Vector3d& scale, double pixels, double detail) {
    const double size = std::max({scale.x, scale.y, scale.z}) * pixels / detail;
    const double level = std::ceil(std::log2(size));
    return static_cast<int>(std::clamp<double>(level, coarsest_level, finest_level));
}

}  // namespace

Instances instances_of(const DrawnCells& cells, double pixels, double detail) {
    Instances instances;
    instances.placements = cells.placements;
    if (cells.file) {
        instances.meshes = {cells.file->mesh};
        for (Placement& each : instances.placements) each.mesh = 0;
        return instances;
    }
    struct Wanted {
        std::uint32_t shape;
        int level;
        auto operator<=>(const Wanted&) const = default;
    };
    std::map<Wanted, std::uint32_t> known;
    std::vector<Wanted> wanted;
    for (Placement& each : instances.placements) {
        const Wanted mesh{each.mesh, level_of(each.scale, pixels, detail)};
        const auto number = static_cast<std::uint32_t>(wanted.size());
        const auto [found, is_new] = known.try_emplace(mesh, number);
        if (is_new) wanted.push_back(mesh);
        each.mesh = found->second;
    }
    instances.meshes.resize(wanted.size());
    Team team(hardware_threads());
    team.run([&](int thread) {
        const auto each = static_cast<std::size_t>(team.size());
        for (auto k = static_cast<std::size_t>(thread); k < wanted.size(); k += each) {
            const SweptDetail fineness{longest_facet, std::exp2(-wanted[k].level)};
            // A shape that turns out to be faulty when its mesh is made gets no triangles.
            auto mesh = mesh_of(parts_of(cells.form, cells.shapes[wanted[k].shape]), fineness);
            if (mesh) instances.meshes[k] = std::move(*mesh);
        }
    });
    return instances;
}

}  // namespace cascade
