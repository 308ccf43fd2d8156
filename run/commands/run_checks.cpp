// Tests whether files and folders can be written, and checks the step of --stop-at.
#include "run/commands/run_checks.h"

#include "core/file.h"
#include "core/file_format.h"
#include "core/temporary_file.h"
#include "export/levels.h"
#include "export/material_maps.h"
#include "film/film.h"
#include "picture/caption.h"
#include "picture/hdf5.h"
#include "picture/vdb.h"
#include "run/commands/run_option.h"
#include "run/pictures/material.h"
#include "run/pictures/model_maps.h"
#include "run/pictures/picture_size.h"
#include "run/pictures/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

namespace cascade {

std::vector<std::filesystem::path> outputs_of(const Script& script, const RunRequest& request) {
    if (!request.outputs.empty()) return request.outputs;
    const std::filesystem::path picture = output_stem(script) + ".png";
    // If the script itself is a picture with this name, writing the output would replace the
    // script.
    std::error_code error;
    if (std::filesystem::equivalent(picture, script.file, error))
        return {output_stem(script) + "-again.png"};
    return {picture};
}

std::filesystem::path log_path(const RunRequest& request,
                               const std::filesystem::path& first_output) {
    if (!request.log.file.empty()) return request.log.file;
    return std::filesystem::path(first_output).replace_extension(".csv");
}

std::vector<std::filesystem::path> turntable_paths(const std::filesystem::path& picture,
                                                   int count) {
    const std::size_t digits = std::max<std::size_t>(3, fmt::formatted_size("{}", count));
    std::vector<std::filesystem::path> paths;
    for (int k = 1; k <= count; ++k) {
        std::filesystem::path path = picture;
        std::filesystem::path name = picture.stem();
        name += fmt::format("-{:0{}}", k, digits);
        name += picture.extension();
        paths.push_back(path.replace_filename(name));
    }
    return paths;
}

namespace {

/// A file that a run writes, and what messages call it.
struct OutputFile {
    std::filesystem::path path;
    std::string_view what;
};

std::string_view noun_of(FormatKind kind) {
    if (kind == FormatKind::picture) return "the picture";
    if (kind == FormatKind::figure) return "the figure";
    return kind == FormatKind::film ? "the film" : "the model";
}

std::vector<OutputFile> files_of(const Script& script, const RunRequest& request,
                                 std::span<const std::filesystem::path> outputs) {
    const MapSet maps = has_cells(script) ? MapSet{.heights = true, .normals = true}
                                          : maps_said(script, request.picture.bump != 0);
    const auto levels = static_cast<std::size_t>(request.model_files.levels);
    std::vector<OutputFile> files;
    const auto add = [&](std::span<const std::filesystem::path> paths, std::string_view what) {
        for (const auto& path : paths) files.push_back({path, what});
    };
    for (const auto& output : outputs) {
        const FormatKind kind = output_kind(output).value_or(FormatKind::picture);
        if (kind == FormatKind::picture && request.turntable > 0) {
            add(turntable_paths(output, request.turntable), "the picture");
        } else if (request.model_files.is_baked(output)) {
            for (std::size_t k = 0; k < levels; ++k) {
                add(map_paths_of_level(output, k, maps, request.picture.displace,
                                       request.model_files.map_format),
                    "the baked model");
            }
        } else if (kind == FormatKind::model) {
            for (std::size_t k = 0; k < levels; ++k) {
                const std::filesystem::path path = path_of_level(output, k);
                add({&path, 1}, noun_of(kind));
            }
        } else {
            add({&output, 1}, noun_of(kind));
        }
    }
    if (!request.sheet.empty()) files.push_back({request.sheet, "--sheet"});
    if (!request.log.expressions.empty()) {
        files.push_back({log_path(request, outputs[0]), "the log"});
    }
    if (!request.volume.empty()) files.push_back({request.volume, "--volume"});
    if (!request.series.empty()) add(files_of_series(request.series), "--series");
    return files;
}

}  // namespace

Result<void> check_outputs(const Script& script, const RunRequest& request,
                           std::span<const std::filesystem::path> outputs) {
    std::vector<OutputFile> files = files_of(script, request, outputs);
    std::set<std::filesystem::path> folders;
    for (const OutputFile& file : files) {
        if (auto good = check_writable(file.path); !good) return good;
        if (is_film(file.path)) {
            if (auto good = check_film(file.path); !good) return good;
        }
        if (is_of_format(file.path, FileFormat::vdb)) {
            if (auto good = check_vdb(file.path); !good) return good;
        }
        if (is_of_format(file.path, FileFormat::h5)) {
            if (auto good = check_hdf5(file.path); !good) return good;
        }
        folders.insert(file.path.parent_path());
    }
    for (const auto& folder : folders) remove_dead_temporaries(folder);
    std::stable_sort(files.begin(), files.end(), [](const OutputFile& a, const OutputFile& b) {
        return a.path.lexically_normal() < b.path.lexically_normal();
    });
    const auto twice =
        std::adjacent_find(files.begin(), files.end(),
                           [](const OutputFile& a, const OutputFile& b) {
                               return a.path.lexically_normal() == b.path.lexically_normal();
                           });
    if (twice == files.end()) return {};
    return failure(fmt::format("{} and {} would both be written to {}", twice[0].what,
                               twice[1].what, twice->path.string()));
}

Result<void> check_film_sizes(const Script& script, const RunRequest& request,
                              const std::atomic<bool>& cancel) {
    const PictureSize size = picture_size(script, request.picture);
    for (const auto& output : request.outputs) {
        if (!is_film(output)) continue;
        if (auto good = check_film_size(output, size.width, size.height, cancel); !good) {
            return good;
        }
    }
    if (request.labels.empty() || has_room_for_caption(size.width, size.height)) return {};
    return failure(fmt::format("frames of {} × {} pixels have no room for a label", size.width,
                               size.height),
                   "use a larger --scale or --size");
}

Result<void> check_folders(const RunRequest& request, Folders folders) {
    for (const auto& folder : {request.frames, request.save}) {
        if (folder.empty()) continue;
        std::error_code error;
        std::vector<std::filesystem::path> missing;
        for (auto above = std::filesystem::absolute(folder, error);
             above.has_relative_path() && !std::filesystem::exists(above, error);
             above = above.parent_path()) {
            missing.push_back(above);
        }
        Result<void> good = make_folder(folder);
        if (good) good = check_writable(folder / "run.json");
        if (good) remove_dead_temporaries(folder);
        if (folders == Folders::tried) {
            for (const auto& made : missing) std::filesystem::remove(made, error);
        }
        if (!good) return good;
    }
    return {};
}

void check_stop_at(Script& script, const StopAt& wanted) {
    const std::string text = fmt::format("{}:{}", wanted.stage, wanted.step);
    Span span = option_span(script.sources, flag_of(RunOption::stop_at), text);
    const auto length = static_cast<std::uint32_t>(wanted.stage.size());
    const auto stage =
        find_stage_of_option(script, wanted.stage, {span.source, span.begin, span.begin + length});
    if (!stage) return;
    if (*stage >= script.stage_count()) {
        script.diagnostics.error(span, fmt::format("stage '{}' does not run", wanted.stage),
                                 "--until-stage ends the run before this stage");
        return;
    }
    const std::int64_t iterations = script.program->stages[*stage].iterations;
    if (wanted.step <= iterations) return;
    span.begin = length + 1;
    script.diagnostics.error(span,
                             fmt::format("stage '{}' has only {} steps", wanted.stage, iterations));
}

}  // namespace cascade
