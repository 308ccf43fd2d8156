// Collects the arguments of the writer for each kind of content.
#include "run/pictures/shown_files.h"

#include "run/pictures/body_picture.h"
#include "run/pictures/cell_files.h"
#include "run/pictures/grid_files.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/plane_look.h"
#include "run/pictures/series.h"

#include <memory>
#include <utility>
#include <vector>

namespace cascade {
namespace {

/// Makes channels for the species of the shown stage and, if requested, for the number of the
/// canvas.
std::vector<Channel> channels_of(const ShownThings& shown, const FieldNumbers& of_species,
                                 const FieldNumbers& of_canvas) {
    std::vector<Channel> channels = species_channels(shown.simulation, of_species);
    if (shown.has_number) channels.push_back({"shown", of_canvas(shown.canvas.fields[0])});
    return channels;
}

FileWriter writer_of_cells(ShownThings shown) {
    std::vector<Colour> colours = shown.painter.colours_of_row(shown.canvas);
    return [shown = std::move(shown),
            colours = std::move(colours)](const std::filesystem::path& path) {
        const GrownCells cells{shown.simulation, shown_stage(shown.simulation), *shown.canvas.cells,
                               colours};
        return write_cells(path, cells, shown.texture, shown.options, shown.texts);
    };
}

FileWriter writer_of_model(ShownThings shown) {
    const ModelCells& model = *shown.simulation.domain().model->cells;
    const FieldNumbers numbers = [&](const Field& field) { return numbers_of_cells(field, model); };
    auto look = std::make_shared<ModelLook>(shown.painter.look(shown.canvas));
    auto writer = std::make_shared<ModelFileWriter>(model, shown.texture, *look,
                                                    channels_of(shown, numbers, numbers),
                                                    shown.options, std::move(shown.texts));
    return [look, writer](const std::filesystem::path& path) { return writer->write(path); };
}

FileWriter writer_of_body(const ShownThings& shown) {
    const SurfaceMesh& body = *shown.canvas.body;
    const Grid& grid = shown.simulation.domain().grid;
    const FieldNumbers of_points = [&](const Field& row) {
        return std::vector<float>(row.row(0), row.row(0) + body.points.size());
    };
    auto channels = channels_of(
        shown, [&](const Field& field) { return of_points(at_points(field, body, grid.boundary)); },
        of_points);
    return
        [&body, &grid, levels = shown.options.levels, channels = std::move(channels),
         colours = shown.painter.colours_of_row(shown.canvas)](const std::filesystem::path& path) {
            return write_body(path, body, grid, {colours, channels}, levels);
        };
}

FileWriter writer_of_plane(ShownThings shown) {
    Painter& painter = shown.painter;
    auto look = std::make_shared<const PlaneLook>(painter.plane_look(
        painter.map_canvas(shown.simulation, shown.options.bake), painter.range_of(shown.canvas)));
    return [shown = std::move(shown), look](const std::filesystem::path& path) {
        return write_plane(path, *look, shown.options, shown.texts);
    };
}

}  // namespace

FileWriter writer_of(ShownThings shown) {
    if (shown.canvas.cells) return writer_of_cells(std::move(shown));
    if (shown.simulation.domain().model) return writer_of_model(std::move(shown));
    if (shown.canvas.body) return writer_of_body(shown);
    return writer_of_plane(std::move(shown));
}

}  // namespace cascade
