// The part of the public library (include/cascade/cascade.h) that writes the present moment of a
// pattern to files: pictures, models, volumes and pages.
#include "core/file.h"
#include "core/file_format.h"
#include "library/file_options.h"
#include "library/pattern_state.h"
#include "run/commands/run.h"
#include "run/pictures/series.h"
#include "run/script/embedded_script.h"
#include "view/standalone_page.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace cascade {
namespace {

/// The endings of all files that write() writes.
std::string endings_of_files() {
    std::string endings;
    for (const FormatRow& format : file_formats) {
        if (format.kind > FormatKind::volume) continue;
        endings += (endings.empty() ? "" : ", ") + std::string(format.ending);
    }
    return endings;
}

}  // namespace

bool Pattern::Implementation::write_by_runner(RunRequest request) {
    const Script& now = run->script();
    Script script = load_script(now.name, now.text, now.folder, now.overrides);
    request.present = run.get();
    if (!run->is_resumed()) request.session = run->log();
    // The interpreter is enough, because no steps are taken.
    request.simulation.backend = "interp";
    RunControl own_control;
    const auto report = cascade::run(script, request, own_control);
    if (report) return true;
    if (script.diagnostics.has_errors()) note(script.diagnostics, script.sources);
    else note(report.error());
    return false;
}

/// Volumes are written directly, because a run would also draw a picture.
bool Pattern::Implementation::write_volume_file(const std::filesystem::path& path) {
    const bool is_volume = run->script().program->domain.grid.depth > 1;
    const bool has_grid = !model() && run->simulation().state(stage()).tissue() == nullptr;
    if (!has_grid || (!is_volume && !can_hold(path, FormatTrait::planes))) {
        note({fmt::format("a {} file can hold only a volume, but this pattern is not a volume",
                          lower_ending(path)),
              "a model is written as .vtp, and crawling cells as .cells.vtp"});
        return false;
    }
    const auto written =
        write_volume(path, run->simulation(), embed_script(run->script(), PictureRequest()));
    if (!written) note(written.error());
    return written.has_value();
}

bool Pattern::write(const std::string& path, const std::string& options) {
    if (!self_->running() || !self_->check()) return false;
    self_->forget_error();
    auto request = file_request(options);
    if (!request) {
        self_->note(request.error());
        return false;
    }
    if (is_of_kind(path, FormatKind::volume)) return self_->write_volume_file(path);
    if (!output_kind(path)) {
        self_->note({fmt::format("write() has no format for the ending of '{}'", path),
                     fmt::format("it writes {}", endings_of_files())});
        return false;
    }
    const bool films_end = request->turntable > 0 || request->slices > 0;
    if (is_film(path) && !films_end) {
        self_->note({fmt::format("'{}' would be a film of one moment", path),
                     "use film() to show the steps, or write() with 'turntable' (for volumes "
                     "'slices') to show the present moment from all sides"});
        return false;
    }
    request->outputs = {path};
    return self_->write_by_runner(*std::move(request));
}

std::string Pattern::page() {
    if (!self_->running()) return "";
    self_->forget_error();
    const auto engine = read_engine();
    const auto carried = engine ? carried_by(self_->run->script(), self_->run->simulation())
                                : tl::unexpected(engine.error());
    if (carried) return standalone_page(*carried, *engine);
    self_->note(carried.error());
    return "";
}

}  // namespace cascade
