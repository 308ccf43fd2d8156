// Draws the figures of a run: the picture with labelled axes and a bar of its colours.
#include "core/file.h"
#include "core/printable.h"
#include "lang/check/check_dimensions.h"
#include "run/commands/run_results.h"
#include "run/pictures/figure.h"
#include "run/pictures/measured.h"
#include "run/simulation/grown_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade {

namespace {

/// Returns a title with the name of the script, the name of the shown stage, and the time in that
/// stage.
std::string title_of(const Script& script, const Simulation& simulation) {
    const std::uint32_t stage = shown_stage(simulation);
    std::string title =
        fmt::format("{}: {}", printable(std::filesystem::path(script.name).filename().string()),
                    script.program->stages[stage].name);
    const double time = time_of(simulation, stage);
    const ProgramUnits units = units_of_program(script.tree, *script.program);
    const std::string unit = units.name_of(BaseQuantity::time);
    if (std::isfinite(time)) {
        title += fmt::format(", t = {:.6g}{}{}", time, unit.empty() ? "" : " ", unit);
    }
    return title;
}

/// Returns the name of an axis with its unit: `x (mm)`, or `x` if there is no unit.
std::string with_unit(std::string name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

/// Evaluates a part of a formula. Returns an empty optional if the part reads anything that is not
/// a number.
std::optional<double> number_in(const Simulation& simulation, const Formula& formula, NodeId part) {
    const Formula number = formula_of(formula.nodes, part);
    const bool is_known = std::ranges::all_of(number.nodes, [](const Node& node) {
        return node.is<double>() || (node.is<Call>() && !varies_by_cell(node.function));
    });
    if (!is_known) return std::nullopt;
    const std::array formulas{&number};
    return evaluate_numbers(simulation, formulas, shown_stage(simulation)).front();
}

/// Returns the unit of a part of a formula of the shown stage, or an empty string if the part has
/// no unit.
std::string unit_of_part(const Script& script, const Simulation& simulation, const Formula& formula,
                         NodeId part) {
    return unit_of_formula(script.tree, *script.program, shown_stage(simulation),
                           formula_of(formula.nodes, part));
}

/// Makes the bar that explains the colours of a formula. Returns an empty optional unless the whole
/// formula is palette(e, low, high, "name") with numbers for low and high.
std::optional<ColourBar> bar_of(const Script& script, const Simulation& simulation,
                                const std::optional<Formula>& formula) {
    if (!formula || !formula->nodes.back().calls(Function::palette)) return std::nullopt;
    const auto& [value, from, to, palette, e, f] = formula->nodes.back().operands;
    const auto low = number_in(simulation, *formula, from);
    const auto high = number_in(simulation, *formula, to);
    const auto* const name = formula->nodes[palette].as<TextId>();
    if (!low || !high || name == nullptr) return std::nullopt;
    return ColourBar{find_palette(script.program->literals->text(*name)),
                     {static_cast<float>(*low), static_cast<float>(*high)},
                     with_unit(std::string(script.sources.text(formula->nodes[value].span)),
                               unit_of_part(script, simulation, *formula, value))};
}

/// Returns the extent of a flat picture in the script's unit of length. The picture may show
/// several copies of the plane.
PlaneExtent extent_of(const Simulation& simulation, const PictureRequest& request,
                      const std::string& unit) {
    constexpr std::array names{"x", "y", "z"};
    const Grid& grid = simulation.domain().grid;
    const PlaneLayout layout(grid);
    const bool is_slice = grid.depth > 1;
    const Grid shown = is_slice ? slice_grid(layout, request.slice) : grid;
    const std::size_t across = is_slice && request.slice.axis == Axis::x ? 2 : 0;
    const std::size_t down = is_slice && request.slice.axis == Axis::y ? 2 : 1;
    const auto cells = cell_lengths(simulation, shown_stage(simulation));
    const auto length = [&](std::int64_t count, int copies, std::size_t axis) {
        return static_cast<double>(count * copies) * cells[axis];
    };
    return {length(shown.width, request.copies.across, across),
            length(shown.height, request.copies.down, down), with_unit(names[across], unit),
            with_unit(names[down], unit)};
}

}  // namespace

Drawing RunResults::figure_of(Painter& of, const Canvas& canvas, const std::string& title) const {
    const PictureRequest& wanted = of.request();
    const ProgramUnits units = units_of_program(script.tree, *script.program);
    const std::string length_unit = units.name_of(BaseQuantity::length);
    std::string name = name_of_number(script, shown_stage(simulation), wanted);
    if (!canvas.is_colour()) {
        const std::uint32_t stage = shown_stage(simulation);
        const Formula shown = of.formula(simulation).value_or(script.program->stages[stage].show);
        name = with_unit(name, unit_of_formula(script.tree, *script.program, stage, shown));
    }
    const Grid& grid = simulation.domain().grid;
    if (of.is_flat() && grid.height == 1 && grid.depth == 1 && !canvas.is_colour()) {
        std::vector<double> values;
        const Field& line = canvas.fields[0];
        for (std::int64_t k = 0; k < line.layout().width; ++k) values.push_back(line.at(k, 0));
        const double cell = cell_lengths(simulation, shown_stage(simulation))[0];
        return draw_curve_figure(values, static_cast<double>(grid.width) * cell, title, name,
                                 with_unit("x", length_unit));
    }
    const Image picture = of.image(canvas);
    std::optional<PlaneExtent> plane;
    if (of.is_flat()) plane = extent_of(simulation, wanted, length_unit);
    const auto bar = canvas.is_colour() ? bar_of(script, simulation, of.formula(simulation))
                                        : ColourBar{&of.palette(), of.range_of(canvas), name};
    return draw_figure(picture, title, plane, bar);
}

Result<void> RunResults::write_figure(const std::filesystem::path& path, const Canvas& canvas) {
    const std::string title = title_of(script, simulation);
    std::vector<Drawing> drawings;
    for (Painter& panel : panels) {
        const char letter = static_cast<char>('a' + drawings.size());
        drawings.push_back(figure_of(panel, panel.canvas(simulation),
                                     fmt::format("({}) {}", letter, panel.request().show)));
    }
    auto done = write_drawing(path, drawings.empty() ? figure_of(painter, canvas, title)
                                                     : side_by_side(drawings, title));
    if (done) report.written.push_back(path);
    return done;
}

}  // namespace cascade
