// In scripts, models are upright and their longest side is 1. Files use the coordinates of the
// model's file.
#include "run/pictures/cell_files.h"

#include "core/counted.h"
#include "core/file_format.h"
#include "core/run_control.h"
#include "export/bake.h"
#include "export/instanced_model.h"
#include "export/placed_cells.h"
#include "run/pictures/refined_model.h"
#include "run/pictures/cells_from_outside.h"
#include "run/pictures/model_picture.h"
#include "tissue/tissue.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// Converts positions from the script's unit of length to the coordinates of a file.
class FilePlaces {
public:
    explicit FilePlaces(const ModelCells* model) {
        if (model == nullptr) return;
        box_.emplace(model->mesh);
        stance_ = model->stance;
    }

    Vector3d place(Vector3d p) const {
        return box_ ? turned_from_upright(box_->in_model(p), stance_) : p;
    }
    double length(double l) const { return box_ ? l * box_->longest : l; }
    Quaternion turn(const Quaternion& q) const {
        const auto axis = [&](Vector3d v) { return turned_from_upright(turned(q, v), stance_); };
        return quaternion_of(axis({1, 0, 0}), axis({0, 1, 0}), axis({0, 0, 1}));
    }

private:
    std::optional<ModelBox> box_;
    Stance stance_;
};

/// In files, facets are as fine as in a picture with this height in pixels, and with this value of
/// `detail`.
constexpr double pixels_of_files = 200, detail_of_files = 0.5;

/// Returns the objects of a picture in the coordinates of the model's file.
Instances things_in_file(const GrownCells& cells) {
    const auto model = cells.simulation.domain().shared_model();
    const FilePlaces in_file(model.get());
    Instances copies = instances_of(cells.drawn, pixels_of_files, detail_of_files);
    for (std::size_t k = 0; k < copies.placements.size(); ++k) {
        Placement& each = copies.placements[k];
        each.place = in_file.place(each.place);
        each.turn = in_file.turn(each.turn);
        each.scale = each.scale * in_file.length(1);
        each.colour = cells.colours[cells.drawn.cells[k]];
    }
    return copies;
}

/// The model below the cells, in the coordinates of its file, and its colours.
class Skin {
public:
    Skin(const ModelCells& model, const MeshTexture& texture, const DrawnCells& drawn)
        : mesh(mesh_in_files(model, texture)), model_(model), team_(hardware_threads()) {
        colours.colour = drawn.skin;
        if (!drawn.coat) return;
        filter_.emplace(mesh, model.spread().cells, team_);
        colours.filter = &*filter_;
        colours.coat = drawn.coat->painted();
    }

    /// Returns the colours of the mesh's points. If there is a coat, refines the mesh first.
    std::vector<Colour> colour_points() {
        if (!filter_) return std::vector<Colour>(mesh.points.size(), colours.colour);
        RefinedMesh fine = refined_for_colours(mesh, model_.spread().cells);
        mesh = std::move(fine.mesh);
        return colours_at(fine.places, *filter_, colours.coat, team_);
    }

    Team& team() { return team_; }

    SurfaceMesh mesh;
    SkinColours colours;

private:
    const ModelCells& model_;
    Team team_;
    std::optional<CellFilter> filter_;
};

/// Returns notes about programs that cannot read the copies in a file.
std::vector<std::string> notes_on(const std::filesystem::path& path, std::size_t copies,
                                  bool is_merged) {
    if (is_merged || copies == 0 || !is_of_format(path, FileFormat::glb)) return {};
    return {fmt::format(
        "{} has {} by EXT_mesh_gpu_instancing; programs that lack it, such as "
        "Blender 3.4, need --merge",
        path.filename().string(), counted(static_cast<std::int64_t>(copies), "copy", "copies"))};
}

Result<WrittenFiles> write_things(const std::filesystem::path& path, const GrownCells& cells,
                                  const MeshTexture& texture, bool is_merged) {
    const Instances copies = things_in_file(cells);
    WrittenFiles written{{path}, {}, notes_on(path, copies.placements.size(), is_merged)};
    const DrawnCells& drawn = cells.drawn;
    const auto model = cells.simulation.domain().shared_model();
    const auto write = [&](const InstancedModel& all) -> Result<WrittenFiles> {
        if (auto done = write_instanced(path, all, is_merged); !done)
            return tl::unexpected(done.error());
        return written;
    };
    if (!model) return write({drawn.body.get(), drawn.body_colours, copies});
    Skin skin(*model, texture, drawn);
    const std::vector<Colour> colours = skin.colour_points();
    return write({&skin.mesh, colours, copies});
}

Result<WrittenFiles> write_maps(const std::filesystem::path& path, const GrownCells& cells,
                                const MeshTexture& texture, const ModelFileOptions& files,
                                const PngTexts& texts) {
    Skin skin(*cells.simulation.domain().model->cells, texture, cells.drawn);
    const CellsFromOutside outside(skin.mesh, things_in_file(cells));
    BakeOptions options;
    options.width = options.height = files.bake;
    const auto painter = [&] { return std::make_unique<OutsideSamples>(outside, skin.colours); };
    const auto baked = bake(skin.mesh, painter, options, skin.team(), never_cancelled);
    if (!baked) return tl::unexpected(baked.error());
    if (auto done = cascade::write_maps(path, skin.mesh, *baked, texts, files.map_format); !done) {
        return tl::unexpected(done.error());
    }
    return WrittenFiles{map_paths(path, baked->maps, files.map_format), baked->warnings};
}

Result<void> write_values(const std::filesystem::path& path, const GrownCells& cells) {
    const StageState& state = cells.simulation.state(cells.stage);
    const Program& program = *cells.simulation.domain().program;
    const System& system = program.system_of(cells.stage);
    const CellRules& rules = *system.cells;
    const auto model = cells.simulation.domain().shared_model();
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
        const std::vector<double> of_item = number_order(state.field(item), *state.tissue());
        channels.push_back({std::string(system.item_name(item)),
                            std::vector<float>(of_item.begin(), of_item.end())});
    }
    return write_cells(path, {frames.places, frames.turns, frames.radii, cells.colours, channels});
}

}  // namespace

Result<WrittenFiles> write_cells(const std::filesystem::path& path, const GrownCells& cells,
                                 const MeshTexture& texture, const ModelFileOptions& options,
                                 const PngTexts& texts) {
    const bool has_things = is_of_kind(path, FormatKind::model);
    if (has_things && options.is_baked(path)) {
        return write_maps(path, cells, texture, options, texts);
    }
    if (has_things) return write_things(path, cells, texture, options.merge);
    if (auto done = write_values(path, cells); !done) return tl::unexpected(done.error());
    return WrittenFiles{{path}};
}

}  // namespace cascade
