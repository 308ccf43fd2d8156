// Scripts know models upright and of length 1; files have the coordinates of the model's file.
#include "run/pictures/cell_files.h"

#include "export/instanced_model.h"
#include "export/placed_cells.h"
#include "tissue/tissue.h"

#include <array>
#include <cmath>
#include <optional>
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
constexpr double pixels_of_files = 200;

Result<void> write_things(const std::filesystem::path& path, const GrownCells& cells,
                          const ModelFileOptions& options) {
    const auto model = cells.simulation.model();
    const FilePlaces in_file(model.get());
    Instances copies = instances_of(cells.drawn, pixels_of_files);
    for (std::size_t k = 0; k < copies.placements.size(); ++k) {
        Placement& each = copies.placements[k];
        each.place = in_file.place(each.place);
        each.turn = in_file.turn(each.turn);
        each.scale = each.scale * in_file.length(1);
        each.colour = cells.colours[cells.drawn.cells[k]];
    }
    SurfaceMesh body;
    if (model) body = model->mesh_of_file();
    const std::vector<Colour> skin(body.points.size(), cells.drawn.skin);
    return write_instanced(path, {model ? &body : nullptr, skin, copies}, options.merge);
}

Result<void> write_values(const std::filesystem::path& path, const GrownCells& cells) {
    const StageState& state = cells.simulation.state(cells.stage);
    const Program& program = cells.simulation.program();
    const System& system = program.system_of(cells.stage);
    const CellRules& rules = *system.cells;
    const Tissue& tissue = *state.tissue;
    const auto model = cells.simulation.model();
    const FilePlaces in_file(model.get());
    const auto values = [&](ItemId first, std::size_t k) {
        return number_order(state.field(ItemId(first.index() + k)), tissue);
    };
    const std::array place{values(rules.place, 0), values(rules.place, 1), values(rules.place, 2)};
    const std::array frame{values(rules.frame, 0), values(rules.frame, 1), values(rules.frame, 2),
                           values(rules.frame, 3)};
    std::vector<double> radii = values(rules.radius, 0);
    std::vector<Vector3d> places;
    std::vector<Quaternion> frames;
    for (std::size_t k = 0; k < tissue.count(); ++k) {
        places.push_back(in_file.place({place[0][k], place[1][k], place[2][k]}));
        frames.push_back(
            in_file.turn(of_length_1({frame[0][k], frame[1][k], frame[2][k], frame[3][k]})));
        radii[k] = in_file.length(radii[k]);
    }
    std::vector<Channel> channels;
    for (const ItemId item : system.quantities.ids()) {
        const bool is_listed = !rules.has_component(item) && item != rules.radius;
        const bool varies = system.is_species(item) || !program.stages[cells.stage].uniform[item];
        if (!is_listed || !varies) continue;
        const std::vector<double> of_item = values(item, 0);
        channels.push_back({std::string(system.item_name(item)),
                            std::vector<float>(of_item.begin(), of_item.end())});
    }
    return write_cells(path, {places, frames, radii, cells.colours, channels});
}

}  // namespace

Result<void> write_cells(const std::filesystem::path& path, const GrownCells& cells,
                         const ModelFileOptions& options) {
    const bool has_things = output_kind(path) == OutputKind::model;
    return has_things ? write_things(path, cells, options) : write_values(path, cells);
}

}  // namespace cascade
