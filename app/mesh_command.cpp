// The command `cascade mesh` describes 3-D models. It also writes models, repaired and, as options
// request, refined, simplified or unwrapped.
#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/json_answer.h"
#include "app/last_moments.h"
#include "core/enough_memory.h"
#include "core/file_format.h"
#include "lang/vocabulary/settings.h"
#include "run/domain/describe_model.h"
#include "run/pictures/model_files.h"
#include "run/pictures/plain_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <optional>

namespace cascade {

namespace {

/// Handles models one after the other: describes each and writes it if requested.
class MeshCommand {
public:
    MeshCommand(const Options& options, Console& console, std::optional<CellOptions> cells,
                const std::atomic<bool>& cancel)
        : options_(options), console_(console), cells_(std::move(cells)), cancel_(cancel) {}

    /// Describes a model. Prints nothing if the model cannot be used.
    Result<void> describe(const std::string& model) {
        const std::vector<std::string> surfaces = words_taken_by(Setting::surface);
        if (std::ranges::find(surfaces, model) != surfaces.end() &&
            !std::filesystem::exists(model)) {
            return failure(fmt::format("'{}' is a surface of Cascade, not a file", model),
                           fmt::format("'cascade run SCRIPT --mesh {0} -o {0}.obj' writes it with "
                                       "its pattern",
                                       model));
        }
        auto made = read_and_repair(model, options_.overrides.reads);
        if (!made) return tl::unexpected(made.error());
        std::vector<std::string> lines = describe_model(*made);
        if (auto done = change(made->mesh, lines); !done) return in_model(model, done.error());
        if (options_.lists_points && !cancel_) {
            const auto points = enough_memory_for(
                [&]() -> Result<std::vector<std::string>> {
                    return describe_points(made->mesh, cancel_);
                },
                "there is not enough memory to find its points");
            if (!points) return in_model(model, points.error());
            lines.insert(lines.end(), points->begin(), points->end());
        }
        if (cells_) {
            auto about = describe_cells(made->mesh, *cells_, team_, cancel_);
            if (!about) return in_model(model, about.error());
            lines.insert(lines.end(), about->begin(), about->end());
        }
        if (cancel_) return {};
        if (JsonAnswer* const all = console_.answer()) {
            (*all)["models"].push_back({{"file", model},
                                        {"points", made->mesh.points.size()},
                                        {"triangles", made->mesh.triangles.size()},
                                        {"facts", lines}});
        }
        console_.print(model + "\n");
        for (const std::string& line : lines) console_.print("  " + line + "\n");
        return {};
    }

private:
    static Result<void> in_model(const std::string& model, const Failure& why) {
        return failure("'" + model + "': " + why.message, why.hint);
    }

    /// Changes a mesh according to the options, and writes the result.
    Result<void> change(SurfaceMesh& mesh, std::vector<std::string>& lines) {
        auto reshaped =
            enough_memory_for([&] { return reshape(mesh, options_.reshaping, cancel_); },
                              "there is not enough memory to change its triangles");
        if (!reshaped) return tl::unexpected(reshaped.error());
        lines.insert(lines.end(), reshaped->begin(), reshaped->end());
        if (options_.mesh_files.unwrap && !cancel_) {
            auto texture = made_texture(mesh, usual_texels, team_, cancel_);
            if (!texture) return tl::unexpected(texture.error());
            mesh.texture = *std::move(texture);
            if (!cancel_) lines.push_back("made " + describe_texture(mesh));
        }
        if (options_.mesh_output.empty() || cancel_) return {};
        auto done = write_plain_model(options_.mesh_output, mesh);
        if (!done) return tl::unexpected(done.error());
        lines.push_back("written to " + options_.mesh_output.string());
        lines.insert(lines.end(), done->begin(), done->end());
        return {};
    }

    const Options& options_;
    Console& console_;
    std::optional<CellOptions> cells_;
    const std::atomic<bool>& cancel_;
    Team team_{hardware_threads()};
};

/// Returns an error if options contradict each other, and an empty optional if they do not.
std::optional<Failure> misuse(const Options& options) {
    const bool spreads = options.cells && options.cells->kind == CellKind::places;
    if (options.cell_seed && !spreads) {
        return Failure{"--seed has no effect without a number of --cells", ""};
    }
    if (options.mesh_output.empty()) return std::nullopt;
    if (options.models.size() > 1) {
        return Failure{"-o takes the file of one model, but several models are given", ""};
    }
    if (options.mesh_files.unwrap && !can_hold(options.mesh_output, FormatTrait::texture)) {
        return Failure{"'" + options.mesh_output.string() + "' cannot hold texture coordinates",
                       endings_of(FormatTrait::texture, "and") + " files can"};
    }
    return std::nullopt;
}

}  // namespace

int mesh_command(const Options& options, Console& console) {
    if (auto wrong = misuse(options)) {
        console.fail(*wrong);
        return exit_status::wrong_use;
    }
    std::optional<CellOptions> cells = options.cells;
    if (options.cell_seed) cells->seed = *options.cell_seed;
    std::atomic<bool> cancel = false;
    std::atomic<bool> hurry = false;
    const std::atomic<bool> may_end = true;
    const LastMoments last(0, hurry, may_end);
    const InterruptGuard interrupt(cancel);
    MeshCommand command(options, console, cells, cancel);
    int status = exit_status::success;
    for (const std::string& model : options.models) {
        const Result<void> done = command.describe(model);
        if (cancel) return exit_status::signal_base + interrupt.signal();
        if (done) continue;
        console.fail(done.error());
        status = exit_status::failed_run;
    }
    return status;
}

}  // namespace cascade
