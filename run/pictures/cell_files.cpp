// Scripts know models upright and of length 1; files have the coordinates of the model's file.
#include "run/pictures/cell_files.h"

#include "export/instanced_model.h"
#include "export/placed_cells.h"
#include "export/refine.h"
#include "run/pictures/model_picture.h"
#include "tissue/tissue.h"

#include <optional>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// From lengths of scripts to the coordinates of a file.
class FilePlaces {
public:
    explicit FilePlaces(const ModelCells* model) {
        if (model == nullptr) return;
        box_.emplace(model->mesh);
        up_ = model->up;
    }

    Vector3d place(Vector3d p) const {
        return box_ ? turned_from_upright(box_->in_model(p), up_) : p;
    }
    double length(double l) const { return box_ ? l * box_->longest : l; }
    Quaternion turn(const Quaternion& q) const {
        const auto axis = [&](Vector3d v) { return turned_from_upright(turned(q, v), up_); };
        return quaternion_of(axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1}));
    }

private:
    std::optional<ModelBox> box_;
    Axis up_ = Axis::y;
};

/// Facets of the things in files are as fine as in a picture of this height.
constexpr double pixels_of_files = 200, detail_of_files = 0.5;

struct Body {
    SurfaceMesh mesh;
    std::vector<Colour> colours;  ///< Of its points.
};

/// In the coordinates of the model's file.
Body body_of(const ModelCells& model, const DrawnCells& drawn) {
    Body body{model.mesh_of_file(), {}};
    if (!drawn.coat) {
        body.colours.assign(body.mesh.points.size(), drawn.skin);
        return body;
    }
    Team team(hardware_threads());
    const CellFilter filter(body.mesh, model.cells, team);
    RefinedMesh fine = refined_for_colours(body.mesh, model.cells);
    const PaintedCells coat{drawn.coat->channels, drawn.coat->values, drawn.coat->colour, {}};
    body.colours = colours_at(fine.places, filter, coat, team);
    body.mesh = std::move(fine.mesh);
    return body;
}

Result<void> write_things(const std::filesystem::path& path, const GrownCells& cells,
                          const ModelFileOptions& options) {
    const auto model = cells.simulation.model();
    const FilePlaces in_file(model.get());
    Instances copies = instances_of(cells.drawn, pixels_of_files, detail_of_files);
    for (std::size_t k = 0; k < copies.placements.size(); ++k) {
        Placement& each = copies.placements[k];
        each.place = in_file.place(each.place);
        each.turn = in_file.turn(each.turn);
        each.scale = each.scale * in_file.length(1);
        each.colour = cells.colours[cells.drawn.cells[k]];
    }
    Body body;
    if (model) body = body_of(*model, cells.drawn);
    return write_instanced(path, {model ? &body.mesh : nullptr, body.colours, copies},
                           options.merge);
}

Result<void> write_values(const std::filesystem::path& path, const GrownCells& cells) {
    const StageState& state = cells.simulation.state(cells.stage);
    const Program& program = cells.simulation.program();
    const System& system = program.system_of(cells.stage);
    const CellRules& rules = *system.cells;
    const auto model = cells.simulation.model();
    const FilePlaces in_file(model.get());
    PlacedFrames frames = frames_of(cells.simulation, cells.stage);
    for (Vector3d& place : frames.places) place = in_file.place(place);
    for (Quaternion& turn : frames.turns) turn = in_file.turn(turn);
    for (double& radius : frames.radii) radius = in_file.length(radius);
    std::vector<Channel> channels;
    for (const ItemId item : system.quantities.ids()) {
        const bool is_listed = !rules.has_component(item) && item != rules.radius;
        const bool varies = system.is_species(item) || !program.stages[cells.stage].uniform[item];
        if (!is_listed || !varies) continue;
        const std::vector<double> of_item = number_order(state.field(item), *state.tissue);
        channels.push_back({std::string(system.item_name(item)),
                            std::vector<float>(of_item.begin(), of_item.end())});
    }
    return write_cells(path, {frames.places, frames.turns, frames.radii, cells.colours, channels});
}

}  // namespace

Result<void> write_cells(const std::filesystem::path& path, const GrownCells& cells,
                         const ModelFileOptions& options) {
    const bool has_things = output_kind(path) == OutputKind::model;
    return has_things ? write_things(path, cells, options) : write_values(path, cells);
}

}  // namespace cascade
