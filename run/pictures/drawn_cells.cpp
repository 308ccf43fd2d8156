// Measures are formulas of the picture block, evaluated in all cells at once.
#include "run/pictures/drawn_cells.h"

#include "core/check.h"
#include "lang/check/check.h"
#include "picture/srgb.h"
#include "run/domain/creased_mesh.h"
#include "tissue/tissue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace cascade {

namespace {

/// The settings of the picture block that are numbers of a cell.
enum Measure : std::size_t { width, length, height, tilt, form, bend, measure_count };
constexpr std::array<std::string_view, measure_count> measure_names{"width", "length", "height",
                                                                    "tilt",  "form",   "bend"};
/// Shapes whose form and bend differ by less than this are one.
constexpr double shape_step = 1.0 / 16;

/// The values of each measure, in the order of numbers; empty where the script does not say it.
using Measures = std::array<std::vector<double>, measure_count>;

Measures measures_of(Script& script, const Simulation& simulation, std::uint32_t stage,
                     const Tissue& tissue) {
    std::vector<Formula> formulas;
    std::vector<Measure> which;
    for (std::size_t k = 0; k < measure_count; ++k) {
        const auto expression = picture_expression(script.tree, measure_names[k]);
        if (!expression) continue;
        Diagnostics unspoken;  // Errors were reported on loading.
        auto formula = check_view(script.tree, *expression, stage, stage, *script.program,
                                  script.sources, unspoken);
        if (!formula || formula->nodes.back().type != ValueType::number) continue;
        formulas.push_back(std::move(*formula));
        which.push_back(static_cast<Measure>(k));
    }
    Measures measures;
    if (formulas.empty()) return measures;
    std::vector<const Formula*> each;
    for (const Formula& formula : formulas) each.push_back(&formula);
    const std::vector<Field> values = simulation.evaluate(each, stage);
    for (std::size_t k = 0; k < which.size(); ++k) {
        measures[which[k]] = number_order(values[k], tissue);
    }
    return measures;
}

/// The colour of the surface below the cells, if the script says it.
std::optional<Colour> skin_of(Script& script, const Simulation& simulation, std::uint32_t stage) {
    const auto expression = picture_expression(script.tree, "skin");
    if (!expression) return std::nullopt;
    Diagnostics unspoken;
    const auto formula = check_view(script.tree, *expression, stage, stage, *script.program,
                                    script.sources, unspoken);
    if (!formula || formula->nodes.back().type != ValueType::colour) return std::nullopt;
    const std::vector<Field> parts = simulation.evaluate(*formula, stage);
    Colour colour;
    for (std::size_t k = 0; k < colour.size(); ++k) {
        colour[k] = static_cast<float>(std::clamp(parts[k].number_at(0, 0), 0.0, 1.0));
    }
    return colour;
}

CellShape::Kind kind_of(const Script& script) {
    const auto expression = picture_expression(script.tree, "shape");
    if (!expression) return CellShape::Kind::ball;
    const auto* word = std::get_if<ast::Name>(&script.tree.expressions[expression->root].node);
    const auto kind = word == nullptr ? std::nullopt : find_cell_shape(word->name);
    return kind.value_or(CellShape::Kind::ball);
}

/// About the x axis, from y towards z.
Quaternion leaning(double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    return {std::cos(half), std::sin(half), 0, 0};
}

/// Rounds a number of 0 … 1, so that few shapes are needed.
double rounded(double part) {
    return std::isfinite(part) ? std::round(std::clamp(part, 0.0, 1.0) / shape_step) * shape_step
                               : 0;
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
    const Tissue& tissue = *state.tissue;
    const CellRules& rules = *simulation.program().system_of(stage).cells;
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

DrawnCells drawn_cells(Script& script, const Simulation& simulation, std::uint32_t stage) {
    const StageState& state = simulation.state(stage);
    CHECK(state.tissue, "the stage is one of cells that crawl");
    const Tissue& tissue = *state.tissue;
    const PlacedFrames frames = frames_of(simulation, stage);
    const Measures measures = measures_of(script, simulation, stage, tissue);
    const auto measure = [&](Measure which, std::size_t k, double otherwise) {
        return measures[which].empty() ? otherwise : measures[which][k];
    };
    DrawnCells placed;
    placed.count = tissue.count();
    const Grid& grid = simulation.grid();
    const auto longest = static_cast<double>(grid.longest_side());
    placed.extent = {static_cast<double>(grid.width) / longest,
                     static_cast<double>(grid.height) / longest,
                     grid.depth > 1 ? static_cast<double>(grid.depth) / longest : 0};
    if (const auto skin = skin_of(script, simulation, stage)) placed.skin = *skin;
    const CellShape::Kind kind = kind_of(script);
    std::map<std::pair<double, double>, std::uint32_t> known;  // By form and bend.
    for (std::size_t k = 0; k < tissue.count(); ++k) {
        Placement placement;
        const double wide = measure(width, k, 2 * frames.radii[k]);
        const double high = measure(height, k, frames.radii[k]);
        placement.scale = {wide / 2, high, measure(length, k, wide) / 2};
        placement.place = frames.places[k];
        const auto is_size = [](double size) { return size > 0 && std::isfinite(size); };
        if (!is_size(placement.scale.x) || !is_size(placement.scale.y) ||
            !is_size(placement.scale.z)) {
            continue;
        }
        placement.turn = frames.turns[k];
        const double angle = measure(tilt, k, 0);
        if (std::isfinite(angle)) placement.turn = placement.turn * leaning(angle);
        const CellShape usual;
        const std::pair looks(rounded(measure(form, k, usual.form)),
                              rounded(measure(bend, k, usual.bend)));
        const auto number = static_cast<std::uint32_t>(placed.shapes.size());
        const auto [shape, is_new] = known.try_emplace(looks, number);
        if (is_new) placed.shapes.push_back({kind, looks.first, looks.second});
        placement.mesh = shape->second;
        placed.placements.push_back(placement);
        placed.cells.push_back(k);
    }
    return placed;
}

Instances instances_of(const DrawnCells& cells, double pixels) {
    std::vector<double> largest(cells.shapes.size(), 0);
    for (const Placement& each : cells.placements) {
        double& most = largest[each.mesh];
        most = std::max({most, each.scale.x, each.scale.y, each.scale.z});
    }
    Instances instances;
    for (std::size_t k = 0; k < cells.shapes.size(); ++k) {
        SweptDetail detail;
        detail.tolerance = std::clamp(0.5 / (pixels * largest[k]), 0.003, 0.2);
        detail.longest_edge = 4;
        const auto parts = parts_of(cells.shapes[k]);
        auto mesh = mesh_of(parts, detail);
        CHECK(mesh, "the shapes of the language are sound");
        instances.meshes.push_back(std::move(*mesh));
    }
    instances.placements = cells.placements;
    return instances;
}

namespace {

/// Laid flat, with the plane's normal upwards: y of scripts, which points downwards in pictures,
/// comes towards the viewer. That swaps left and right, so shapes are mirrored, too, in which they
/// are symmetric.
void lay_flat(Instances& copies) {
    const auto swapped = [](Vector3d v) { return Vector3d{v.x, v.z, v.y}; };
    for (Placement& each : copies.placements) {
        each.place = swapped(each.place);
        each.turn = quaternion_of(swapped(turned(each.turn, {-1, 0, 0})),
                                  swapped(turned(each.turn, {0, 1, 0})),
                                  swapped(turned(each.turn, {0, 0, 1})));
    }
}

TriangleMesh floor_of(Vector3d extent) {
    const auto point = [](double x, double z) {
        return Vector3{static_cast<float>(x), 0, static_cast<float>(z)};
    };
    TriangleMesh mesh;
    mesh.positions = {point(0, 0), point(0, extent.y), point(extent.x, extent.y),
                      point(extent.x, 0)};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

}  // namespace

Image draw_cells(const DrawnCells& cells, std::span<const Colour> colours, const ModelCells* model,
                 const DrawOptions& options) {
    Instances copies = instances_of(cells, static_cast<double>(options.height));
    for (std::size_t k = 0; k < copies.placements.size(); ++k) {
        copies.placements[k].colour = colours[cells.cells[k]];
    }
    DrawOptions used = options;
    TriangleMesh body;
    if (model != nullptr) {
        DrawnMesh drawn = creased_mesh(model->mesh);
        const ModelBox box(model->mesh);
        move_instances(copies, box.in_script(drawn.middle), box.longest * drawn.scale);
        body = std::move(drawn.mesh);
        used.round_shadows = true;
    } else {
        lay_flat(copies);
        if (cells.extent.z == 0) body = floor_of(cells.extent);
    }
    const bool has_body = !body.triangles.empty();
    Team team(hardware_threads());
    const Scene scene(has_body ? &body : nullptr, &copies);
    const Look skin{light_of(cells.skin), {}};
    return draw(
        RayCaster(scene), [&](const Sight&) { return skin; }, used, team);
}

}  // namespace cascade
