// The public library (include/cascade/cascade.h), implemented by Script and Simulation.

#include "cascade/cascade.h"

#include "core/failure_line.h"
#include "core/version.h"
#include "run/script/embedded_script.h"
#include "run/pictures/drawn_cells.h"
#include "run/session/session_picture.h"
#include "tissue/tissue.h"

#include <algorithm>
#include <map>
#include <utility>

namespace cascade {

struct Pattern::Implementation {
    std::unique_ptr<LiveRun> run;            ///< Null if the script is wrong.
    std::shared_ptr<const Program> program;  ///< Of a script that could not be run; may be null.
    Diagnostics diagnostics;                 ///< Of the script,
    Sources sources;                         ///< and its sources, where there is no run.
    RunControl control;
    std::string error;
    bool failed = false;
    std::map<std::string, Formula> formulas;  ///< Of values(), by stage and text.

    std::shared_ptr<const ModelCells> model() const {
        return run ? run->simulation().domain().shared_model() : nullptr;
    }
    bool running() const { return run && !failed; }
    const Program* known_program() const {
        return run ? run->script().program.get() : program.get();
    }

    void fail(const Failure& failure) {
        failed = true;
        error = line_of(failure);
    }

    /// Takes over a run, or why there is none.
    void begin(Accepted<std::unique_ptr<LiveRun>> begun) {
        if (begun) {
            run = std::move(*begun);
            return;
        }
        Refusal& refused = begun.error();
        if (refused.failure) fail(*refused.failure);
        diagnostics = std::move(refused.diagnostics);
        sources = std::move(refused.sources);
    }

    /// Notes why a change was refused.
    bool note(const Accepted<void>& done) {
        error = done ? "" : done.error().messages(false);
        if (done) formulas.clear();
        return done.has_value();
    }
    bool change(const Change& made) { return running() && note(run->apply(made, control)); }

    /// The checked expression; null, with `error` set, if it has errors.
    const Formula* formula(const std::string& text);

    std::uint32_t stage() const { return run->place().stage; }
    const Stage& current() const { return run->script().program->stages[stage()]; }
    /// Of all stages so far.
    std::int64_t steps() const {
        std::int64_t steps = 0;
        for (std::uint32_t k = 0; k <= stage(); ++k) steps += run->simulation().state(k).steps;
        return steps;
    }

    /// Are all values of the present step finite? Fails as the steps would have where not.
    bool check() {
        control.cancel = control.checks_later = false;
        if (const auto good = run->check(control); !good) fail(good.error());
        return !failed;
    }
};

namespace {

SimulationOptions simulation_options(const PatternOptions& options) {
    SimulationOptions simulation;
    if (!options.native_code) simulation.backend = "interp";
    simulation.threads = options.threads;
    return simulation;
}

/// The log in the text of a session, or in the bytes of a picture.
Result<SessionLog> log_of(const std::string& session) {
    if (is_session_log(session)) return parse_session_log(session);
    const auto embedded = parse_embedded_script(session, "<picture>");
    if (!embedded) return parse_session_log(session);
    if (embedded->session.empty()) return failure("this picture carries no session");
    return parse_session_log(embedded->session);
}

}  // namespace

Pattern::Pattern() : self_(std::make_unique<Implementation>()) {}

Pattern::Pattern(const std::string& text, const PatternOptions& options) : Pattern() {
    Script script = load_script(options.name, text, options.folder);
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
        const Source& source = sources[diagnostic.span.source];
        const Location place = source.locate(diagnostic.span.begin);
        messages.push_back({diagnostic.severity == Severity::error, source.name(),
                            static_cast<int>(place.line), static_cast<int>(place.column),
                            diagnostic.message, diagnostic.hint});
    }
    return messages;
}

std::string Pattern::messages() const {
    return self_->run ? self_->run->script().messages(false)
                      : render(self_->diagnostics, self_->sources, {});
}
std::string Pattern::error() const { return self_->error; }

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

std::int64_t Pattern::step(std::int64_t count) {
    if (!self_->running()) return 0;
    self_->control.cancel = false;
    self_->control.checks_later = true;
    const std::int64_t before = self_->steps();
    Watching watching;
    watching.begins_next = true;
    const auto end =
        self_->run->advance(std::max<std::int64_t>(count, 0), self_->control, watching);
    if (!end) self_->fail(end.error());
    // Fewer than none where a value that is not finite takes back steps of earlier calls.
    return std::max<std::int64_t>(self_->steps() - before, 0);
}

bool Pattern::finished() const { return self_->running() && self_->run->is_over(); }

std::string Pattern::current_stage() const { return self_->run ? self_->current().name : ""; }
std::int64_t Pattern::steps() const { return self_->run ? self_->run->place().steps : 0; }

bool Pattern::set(const std::string& name, const std::string& expression) {
    return self_->change(SetNumber{name, expression});
}
bool Pattern::set_script(const std::string& script) { return self_->change(SetText{script}); }
bool Pattern::paint(const std::string& item, const std::string& expression) {
    return self_->change(Paint{item, expression});
}
bool Pattern::begin_next_stage() { return self_->change(NextStage{}); }
bool Pattern::undo() { return self_->running() && self_->note(self_->run->undo(self_->control)); }
bool Pattern::redo() { return self_->running() && self_->note(self_->run->redo(self_->control)); }
std::string Pattern::session() const {
    return self_->run ? print_session_log(self_->run->log()) : "";
}

std::string Pattern::picture(const std::string& expression) {
    if (!self_->running() || !self_->check()) return "";
    auto file = session_picture(*self_->run, picture_of(expression));
    self_->error = file ? "" : file.error().messages(false);
    return file ? std::move(*file) : "";
}

const Formula* Pattern::Implementation::formula(const std::string& text) {
    // The same text in another stage is another expression.
    const std::string key = current().name + ":" + text;
    if (const auto known = formulas.find(key); known != formulas.end()) return &known->second;
    Diagnostics errors;
    auto checked = run->number("<values>", text, errors);
    if (!checked) {
        error = render(errors, run->script().sources, {});
        return nullptr;
    }
    return &formulas.emplace(key, std::move(*checked)).first->second;
}

std::vector<float> Pattern::values(const std::string& text) {
    if (!self_->running() || !self_->check()) return {};
    self_->error.clear();
    const Formula* formula = self_->formula(text);
    if (!formula) return {};
    Field field = std::move(self_->run->simulation().evaluate(*formula, self_->stage())[0]);
    if (const Tissue* cells = self_->run->simulation().state(self_->stage()).tissue.get()) {
        const std::vector<double> in_order = number_order(field, *cells);
        return {in_order.begin(), in_order.end()};
    }
    if (const auto model = self_->model()) field = in_one_row(field, *model);
    std::vector<float> values;
    field.visit([&](const auto& plane) {
        for (std::int64_t row = 0; row < plane.layout().row_count(); ++row) {
            std::transform(plane.row(row), plane.row(row) + width(), std::back_inserter(values),
                           [](auto value) { return static_cast<float>(value); });
        }
    });
    return values;
}

void Pattern::cancel() { self_->control.cancel = true; }

const char* library_version() { return version().data(); }

}  // namespace cascade
