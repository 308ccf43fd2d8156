// The command `cascade import` converts a model of another program to a script.
#include "app/commands.h"
#include "app/exit_status.h"
#include "core/file.h"
#include "core/printable.h"
#include "import/importer.h"
#include "run/simulation/simulation.h"
#include "run/simulation/stage_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade {

namespace {

namespace fs = std::filesystem;

bool is_link(std::string_view text) {
    return text.starts_with("https://") || text.starts_with("http://");
}

/// Makes the name of a script, without an ending, from the name of a file or link.
std::string imported_name(const std::string& source) {
    std::string stem = is_link(source) ? "visualpde" : fs::path(source).stem().string();
    for (char& letter : stem) {
        const bool is_plain = std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' ||
                              letter == '_' || letter == '.';
        if (!is_plain) letter = '_';
    }
    return stem.empty() || stem.starts_with('-') ? "imported" : stem;
}

/// Estimates the longest stable step at the start of the stage, on a grid of few cells with the
/// same spacing. Returns an empty optional if no estimate is possible.
std::optional<double> longest_stable_step(importing::Draft draft, const fs::path& folder) {
    // A field that is read from a file needs the whole grid, so random values replace it. The limit
    // that diffusion sets to the step does not depend on the values.
    for (auto* const part : {&draft.parameters, &draft.starts}) {
        for (std::string& each : *part) {
            const auto file = each.find("field(");
            if (file == std::string::npos) continue;
            each = each.substr(0, each.find(':')) + ": random(0.5, 0.5)";
        }
    }
    Script script = load_script("imported", write_script(draft), folder);
    if (!script.program) return std::nullopt;
    constexpr std::int64_t most = 48;
    const Grid& grid = script.program->domain.grid;
    Overrides smaller;
    smaller.grid = {std::min<std::int64_t>(grid.width, most),
                    std::min<std::int64_t>(grid.height, most),
                    std::min<std::int64_t>(grid.depth, most / 2)};
    script = load_script("imported", write_script(draft), folder, smaller);
    if (!script.program) return std::nullopt;
    SimulationOptions options;
    options.backend = "interp";
    options.threads = 1;
    const auto simulation = Simulation::create(script, options);
    if (!simulation || !(*simulation)->start_stage(0)) return std::nullopt;
    const StageView view = (*simulation)->own_view(0);
    return longest_step(view.stability(view.state().species()), view.step_in_use());
}

/// Shortens a step that would not be stable, and adds a comment about it to the script.
void shorten_step(importing::Draft& draft, const fs::path& folder) {
    if (!draft.has_other_differences) return;
    const auto limit = longest_stable_step(draft, folder);
    if (!limit || draft.speed <= *limit) return;
    if (!draft.may_shorten) {
        draft.remarks.push_back(
            fmt::format("Steps of {} may be too long: differences between neighbouring cells are "
                        "stable up to {:.3g}. The formula computes values of the next step, so a "
                        "shorter step would change its meaning.",
                        importing::number_text(draft.speed), *limit));
        return;
    }
    const double shorter = std::stod(fmt::format("{:.1g}", 0.9 * *limit));
    const double step =
        shorter <= 0.95 * *limit ? shorter : std::stod(fmt::format("{:.2g}", 0.8 * *limit));
    draft.remarks.push_back(fmt::format(
        "The source's step of {} is unstable with the differences of Cascade, which allow {:.3g}; "
        "it was shortened to {}.",
        importing::number_text(draft.speed), *limit, importing::number_text(step)));
    draft.speed = step;
}

class ImportCommand {
public:
    ImportCommand(const Options& options, Console& console)
        : options_(options), console_(console), given_(options.scripts[0]) {}

    int run() {
        const fs::path output =
            options_.new_script.empty()
                ? fs::path(imported_name(options_.preset.empty() ? given_ : options_.preset + ".") +
                           ".cascade")
                : options_.new_script;
        const auto text = is_link(given_) ? Result<std::string>(given_)
                                          : read_file(given_, importing::largest_import);
        if (!text) return refuse(text.error(), exit_status::wrong_script);
        const auto* const format = importing::format_of(given_, *text);
        if (format == nullptr) return refuse(unknown_format(), exit_status::wrong_script);
        importing::Import import{sources_, diagnostics_};
        import.source = sources_.add(is_link(given_) ? "the link" : given_, *text);
        import.name = is_link(given_) ? "a link" : fs::path(given_).filename().string();
        import.stem = output.stem().string();
        if (const auto diffusion = read_diffusion(*format, import); !diffusion) {
            return refuse(diffusion.error(), exit_status::wrong_use);
        }
        if (const auto presets = check_presets(*format); !presets) {
            return refuse(presets.error(), exit_status::wrong_use);
        }
        import.preset = options_.preset;
        if (!options_.presets.empty()) {
            auto more = read_file(options_.presets, importing::largest_import);
            if (!more) return refuse(more.error(), exit_status::wrong_script);
            import.presets = sources_.add(options_.presets.string(), std::move(*more));
        }
        auto draft = format->read(import);
        say_diagnostics();
        if (!draft || diagnostics_.has_errors()) return exit_status::wrong_script;
        return write(std::move(*draft), output);
    }

private:
    int refuse(const Failure& failure, int status) const {
        console_.fail(failure);
        return status;
    }

    Failure unknown_format() const {
        std::string known;
        for (const auto& format : importing::import_formats()) {
            known +=
                fmt::format("{}{} ({})", known.empty() ? "" : ", ", format.name, format.endings);
        }
        return {fmt::format("'{}' has no format that can be imported", given_),
                "the formats are: " + known};
    }

    Result<void> read_diffusion(const importing::ImportFormat& format,
                                importing::Import& import) const {
        for (const std::string& each : options_.diffusion) {
            const auto sign = each.find('=');
            if (sign == std::string::npos || sign == 0) {
                return failure(fmt::format("--diffusion '{}' has no '='", each),
                               "write --diffusion A=0.1");
            }
            import.diffusion[each.substr(0, sign)] = each.substr(sign + 1);
        }
        if (!import.diffusion.empty() && !format.takes_diffusion) {
            return failure(fmt::format("a {} has its own diffusion, so --diffusion has no meaning",
                                       format.name));
        }
        return {};
    }

    Result<void> check_presets(const importing::ImportFormat& format) const {
        if (format.takes_presets) return {};
        for (const auto& [option, is_given] : {std::pair("--preset", !options_.preset.empty()),
                                               std::pair("--presets", !options_.presets.empty())}) {
            if (!is_given) continue;
            return failure(
                fmt::format("a {} is not a preset, so {} has no meaning", format.name, option));
        }
        return {};
    }

    void say_diagnostics() const {
        RenderStyle style;
        style.colour = console_.error().colour;
        console_.say(render(diagnostics_, sources_, style));
    }

    /// Writes the script and the files that it reads. Writes nothing if the script has errors or
    /// one of the files exists.
    int write(importing::Draft draft, const fs::path& output) {
        const fs::path folder = output.has_parent_path() ? output.parent_path() : ".";
        shorten_step(draft, folder);
        const Script script = load_script(output.string(), write_script(draft), folder);
        console_.say(script.messages(console_.error().colour));
        if (!script.program) {
            return refuse({fmt::format("the script of {} would have errors; nothing was written",
                                       given_),
                           "the import of some part of the model is probably wrong"},
                          exit_status::wrong_script);
        }
        std::vector<std::pair<fs::path, std::string_view>> files;
        for (const auto& each : draft.files) files.emplace_back(folder / each.name, each.bytes);
        files.emplace_back(output, script.text);
        for (const auto& [path, bytes] : files) {
            std::error_code error;
            if (fs::exists(path, error)) {
                return refuse({fmt::format("{} already exists", path.string()),
                               "give another name with -o: an import never replaces a file"},
                              exit_status::failed_run);
            }
        }
        for (const auto& [path, bytes] : files) {
            if (auto done = write_file(path, bytes); !done) {
                return refuse(done.error(), exit_status::failed_run);
            }
            console_.print(fmt::format("wrote {}\n", path.string()));
        }
        for (const std::string& each : draft.remarks) console_.note(each);
        if (draft.waits_for_click) {
            console_.note(
                fmt::format("nothing grows until you paint on the pattern: cascade "
                            "view {}",
                            output.string()));
        }
        return exit_status::success;
    }

    const Options& options_;
    Console& console_;
    const std::string& given_;
    Sources sources_;
    Diagnostics diagnostics_;
};

}  // namespace

int import_command(const Options& options, Console& console) {
    return ImportCommand(options, console).run();
}

}  // namespace cascade
