// The part of the public library (include/cascade/cascade.h) that uses a LiveRun to make patterns,
// take their steps and change them.

#include "core/file.h"
#include "core/version.h"
#include "library/pattern_state.h"
#include "run/commands/run.h"
#include "run/script/embedded_script.h"
#include "run/session/session_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

namespace cascade {

namespace {

SimulationOptions simulation_options(const PatternOptions& options) {
    SimulationOptions simulation;
    if (!options.native_code) simulation.backend = "interp";
    simulation.threads = options.threads;
    return simulation;
}

Overrides overrides_of(const PatternOptions& options) {
    Overrides overrides;
    overrides.sets = options.sets;
    overrides.seed = options.seed;
    return overrides;
}

/// Reads the log of a session from its text, or from a picture that contains the session.
Result<SessionLog> log_of(const std::string& session) {
    if (is_session_log(session)) return parse_session_log(session);
    const auto embedded = parse_embedded_script(session, "<picture>");
    if (!embedded) return parse_session_log(session);
    if (embedded->session.empty()) return failure("this picture carries no session");
    return parse_session_log(embedded->session);
}

PatternProgress progress_of(const Progress& progress) {
    return {progress.stage,       progress.stage_number,
            progress.stage_count, progress.step,
            progress.steps,       progress.t,
            progress.duration,    progress.steps_per_second,
            progress.seconds_left};
}

}  // namespace

Message message_of(const Diagnostic& diagnostic, const Sources& sources) {
    const Source& source = sources[diagnostic.span.source];
    const Location place = source.locate(diagnostic.span.begin);
    return {
        diagnostic.severity == Severity::error, source.name(),      static_cast<int>(place.line),
        static_cast<int>(place.column),         diagnostic.message, diagnostic.hint};
}

Message first_of(const Diagnostics& diagnostics, const Sources& sources) {
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        if (diagnostic.severity == Severity::error) return message_of(diagnostic, sources);
    }
    return {};
}

Pattern::Pattern() : self_(std::make_unique<Implementation>()) {}

Pattern::Pattern(const std::string& text, const PatternOptions& options) : Pattern() {
    Script script = load_script(options.name, text, options.folder, overrides_of(options));
    self_->program = script.program;
    self_->begin(LiveRun::begin(std::move(script), simulation_options(options), self_->control));
}

Pattern Pattern::play(const std::string& session, const PatternOptions& options) {
    Pattern pattern;
    const auto log = log_of(session);
    if (!log) {
        pattern.self_->fail(log.error());
        return pattern;
    }
    pattern.self_->begin(
        LiveRun::play(*log, options.folder, simulation_options(options), pattern.self_->control));
    return pattern;
}

Pattern Pattern::open(const std::string& path, const PatternOptions& options) {
    Pattern pattern;
    Implementation& self = *pattern.self_;
    const SimulationOptions simulation = simulation_options(options);
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) {
        auto saved = load_saved_script(path, overrides_of(options));
        if (!saved) {
            self.fail(saved.error());
            return pattern;
        }
        self.program = saved->program;
        self.begin(LiveRun::resume(std::move(*saved), simulation, self.control,
                                   [&](const Script& script, Simulation& begun) {
                                       return restore_run(path, script, begun);
                                   }));
        return pattern;
    }
    const std::string folder = std::filesystem::path(path).parent_path().string();
    if (is_session_log(first_bytes(path, longest_log_beginning))) {
        const auto log = read_file(path, largest_session_log);
        PatternOptions of_log = options;
        of_log.folder = folder;
        if (log) return play(*log, of_log);
        self.fail(log.error());
        return pattern;
    }
    auto file = load_script_file(path, overrides_of(options));
    const auto session = file ? session_of(*file) : tl::unexpected(file.error());
    if (!session) {
        self.fail(session.error());
        return pattern;
    }
    if (*session) {
        self.begin(LiveRun::play(**session, file->script.folder, simulation, self.control));
        return pattern;
    }
    self.program = file->script.program;
    self.begin(LiveRun::begin(std::move(file->script), simulation, self.control));
    return pattern;
}

Pattern::~Pattern() = default;
Pattern::Pattern(Pattern&&) noexcept = default;
Pattern& Pattern::operator=(Pattern&&) noexcept = default;

bool Pattern::ok() const { return self_->running(); }

std::vector<Message> Pattern::diagnostics() const {
    std::vector<Message> messages;
    const bool has_run = self_->run != nullptr;
    const Sources& sources = has_run ? self_->run->script().sources : self_->sources;
    const Diagnostics& all = has_run ? self_->run->script().diagnostics : self_->diagnostics;
    for (const Diagnostic& diagnostic : all.sorted()) {
        messages.push_back(message_of(diagnostic, sources));
    }
    return messages;
}

std::string Pattern::messages() const {
    return self_->run ? self_->run->script().messages(false)
                      : render(self_->diagnostics, self_->sources, {});
}
std::string Pattern::error() const { return self_->error; }
Message Pattern::problem() const { return self_->problem; }

std::int64_t Pattern::width() const {
    if (const auto model = self_->model()) return static_cast<std::int64_t>(model->count());
    const Program* const program = self_->known_program();
    return program ? program->domain.grid.width : 0;
}
std::int64_t Pattern::height() const {
    if (self_->model()) return 1;
    const Program* const program = self_->known_program();
    return program ? program->domain.grid.height : 0;
}
std::int64_t Pattern::depth() const {
    const Program* const program = self_->known_program();
    return program ? program->domain.grid.depth : 0;
}

std::vector<std::string> Pattern::stages() const {
    std::vector<std::string> names;
    const Program* const program = self_->known_program();
    if (!program) return names;
    for (const Stage& stage : program->stages) names.push_back(stage.name);
    return names;
}

std::vector<std::string> Pattern::species(const std::string& stage) const {
    std::vector<std::string> names;
    const Program* const program = self_->known_program();
    for (std::uint32_t k = 0; program && k < program->stages.size(); ++k) {
        if (program->stages[k].name != stage) continue;
        const System& system = program->system_of(k);
        for (const ItemId item : system.species()) {
            const bool has_name = !system.cells || !system.cells->has_component(item);
            if (has_name) names.emplace_back(system.item_name(item));
        }
    }
    return names;
}

std::int64_t Pattern::step(std::int64_t count) { return step(count, {}); }

std::int64_t Pattern::step(std::int64_t count, const ProgressWatcher& watcher) {
    return self_->running() ? self_->advance(count, watcher, {}) : 0;
}

std::int64_t Pattern::Implementation::advance(std::int64_t count, const ProgressWatcher& watcher,
                                              Watching watching) {
    control.cancel = false;
    control.checks_later = true;
    if (watcher) {
        control.report = [&](const Progress& progress) {
            if (!watcher(progress_of(progress))) control.cancel = true;
        };
    }
    const std::int64_t before = steps();
    watching.begins_next = true;
    const auto end = run->advance(std::max<std::int64_t>(count, 0), control, watching);
    control.report = {};
    ++moment;
    if (!end) fail(end.error());
    // The difference is negative if a value that is not finite has undone steps of earlier calls.
    return std::max<std::int64_t>(steps() - before, 0);
}

bool Pattern::run(const ProgressWatcher& watcher) {
    step(std::numeric_limits<std::int64_t>::max(), watcher);
    return finished();
}

bool Pattern::finished() const { return self_->running() && self_->run->is_over(); }

std::string Pattern::current_stage() const { return self_->run ? self_->current().name : ""; }
std::int64_t Pattern::steps() const { return self_->run ? self_->run->place().steps : 0; }
std::uint64_t Pattern::moment() const { return self_->moment; }

bool Pattern::set(const std::string& name, const std::string& expression) {
    return self_->change(SetNumber{name, expression});
}
bool Pattern::set(const std::string& name, double value) {
    if (std::isfinite(value)) return set(name, fmt::format("{}", value));
    self_->note({fmt::format("'{}' cannot be {}", name, value), "parameters are finite numbers"});
    return false;
}
bool Pattern::set_script(const std::string& script) { return self_->change(SetText{script}); }
bool Pattern::paint(const std::string& item, const std::string& expression) {
    return self_->change(Paint{item, expression});
}
bool Pattern::set_values(const std::string& item, const std::vector<double>& values) {
    return self_->change(SetValues{item, values});
}
bool Pattern::begin_next_stage() { return self_->change(NextStage{}); }
bool Pattern::undo() { return self_->running() && self_->took(self_->run->undo(self_->control)); }
bool Pattern::redo() { return self_->running() && self_->took(self_->run->redo(self_->control)); }
std::string Pattern::session() {
    if (!self_->run) return "";
    self_->forget_error();
    if (!self_->run->is_resumed()) return print_session_log(self_->run->log());
    self_->note(
        {"no log can repeat this pattern, because it began with saved values, or because "
         "more than 256 MiB of values were set",
         "save() writes all values"});
    return "";
}

bool Pattern::save(const std::string& folder) {
    if (!self_->running() || !self_->check()) return false;
    self_->forget_error();
    const auto saved = save_run(folder, self_->run->script(), self_->run->simulation());
    if (!saved) self_->note(saved.error());
    return saved.has_value();
}

void Pattern::cancel() { self_->control.cancel = true; }

const char* library_version() { return version().data(); }

}  // namespace cascade
