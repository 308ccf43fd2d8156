// The writers of `-o` write to a temporary folder, from which this file reads what they wrote.
#include "run/session/session_model.h"

#include "core/enough_memory.h"
#include "core/file.h"
#include "export/zip.h"
#include "run/pictures/picture_size.h"
#include "run/pictures/map_size.h"
#include "run/pictures/model_files.h"
#include "run/pictures/model_picture.h"
#include "run/pictures/shown_files.h"
#include "run/script/embedded_script.h"
#include "run/session/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace cascade {
namespace {

namespace fs = std::filesystem;

constexpr double texels_of_cell = 4;
constexpr std::int64_t most_texels_of_session = 2048;
constexpr std::uint64_t largest_saved_file = std::uint64_t{1} << 30;

class EmptyFolder {
public:
    explicit EmptyFolder(fs::path path) : path_(std::move(path)) {
        std::error_code ignored;
        fs::create_directory(path_, ignored);
    }
    ~EmptyFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    EmptyFolder(const EmptyFolder&) = delete;
    EmptyFolder& operator=(const EmptyFolder&) = delete;

private:
    fs::path path_;
};

class ModelSaver {
public:
    ModelSaver(LiveRun& run, Painter& painter, ModelForm form)
        : run_(run), simulation_(run.simulation()), painter_(painter), form_(form) {}

    Result<WrittenFiles> write(const fs::path& path) {
        const Canvas canvas = painter_.canvas(simulation_);
        const auto& model = simulation_.domain().model;
        const bool is_plane = !model && !canvas.cells && !canvas.body;
        if (is_plane && simulation_.domain().program->domain.surface) {
            return failure("a surface given by formulas cannot be written as a model",
                           "surfaces with a name, such as 'surface: torus(1, 0.4)', can be "
                           "written as models");
        }
        if (form_ == ModelForm::maps && !is_plane && !model) {
            return failure("maps can be written only for a model or a plane",
                           "save the model without them");
        }
        if (is_plane || form_ == ModelForm::maps) {
            if (auto made = choose_maps(); !made) return tl::unexpected(made.error());
        }
        return writer_of({simulation_, painter_, canvas, texture_, options_,
                          embed_script(run_.script(), painter_.request())})(path);
    }

private:
    Result<void> choose_maps() {
        options_.texels_per_cell = texels_of_cell;
        if (const auto& model = simulation_.domain().model) {
            const ModelCells& cells = *model->cells;
            if (needs_texture(cells.mesh, options_)) {
                Team team(hardware_threads());
                const auto count = static_cast<std::int64_t>(cells.count());
                auto made =
                    made_texture(cells.mesh, texture_side(options_, count), team, never_cancelled);
                if (!made) return tl::unexpected(made.error());
                texture_ = *std::move(made);
            }
        }
        options_.bake = std::min(map_size_for(texels_of_cell, simulation_, texture_).side,
                                 most_texels_of_session);
        return {};
    }

    LiveRun& run_;
    const Simulation& simulation_;
    Painter& painter_;
    ModelForm form_;
    ModelFileOptions options_;
    MeshTexture texture_;
};

/// Reads the file of a model, or packs all files of a model with maps into a ZIP file.
Result<SavedModel> read_back(const WrittenFiles& written, ModelForm form) {
    std::vector<ZipEntry> entries;
    for (const fs::path& path : written.paths) {
        auto bytes = read_file(path, largest_saved_file);
        if (!bytes) return tl::unexpected(bytes.error());
        if (form == ModelForm::model) return SavedModel{".glb", *std::move(bytes), written.notes};
        entries.push_back({path.filename().string(), *std::move(bytes)});
    }
    auto packed = encode_zip(entries);
    if (!packed) return tl::unexpected(packed.error());
    return SavedModel{"_maps.zip", *std::move(packed), written.notes};
}

}  // namespace

Accepted<SavedModel> session_model(LiveRun& run, PictureRequest request, ModelForm form,
                                   const fs::path& folder) {
    PictureRequest of_body = request;
    of_body.slice = {};
    of_body.flat = false;
    if (draws_body(run.script(), of_body)) request = of_body;
    auto painter = make_painter(run, request);
    if (!painter) return tl::unexpected(std::move(painter.error()));
    if (folder.empty()) return refuse("there is no folder for files on this machine");
    const fs::path place = folder / "saved";
    const EmptyFolder made(place);
    const auto name = fs::path(shown_name(run.script())).stem().string();
    auto saved = enough_memory_for([&]() -> Result<SavedModel> {
        const auto written = ModelSaver(run, *painter, form).write(place / (name + ".glb"));
        if (!written) return tl::unexpected(written.error());
        return read_back(*written, form);
    });
    if (!saved) return refuse(saved.error());
    return *std::move(saved);
}

}  // namespace cascade
