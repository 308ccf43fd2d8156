// The public library (include/cascade/cascade.h), implemented by Script and Simulation.

#include "cascade/cascade.h"

#include "core/version.h"
#include "lang/check/check.h"
#include "lang/syntax/parse.h"
#include "run/script/embedded_script.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace cascade {

struct Pattern::Implementation {
    Script script;
    std::unique_ptr<Simulation> simulation;
    RunControl control;
    std::string error;
    std::uint32_t stage = 0;
    bool failed = false;
    std::map<std::string, Formula> formulas;  ///< Of values(), by stage and text.

    std::shared_ptr<const ModelCells> model() const {
        return simulation ? simulation->model() : nullptr;
    }
    bool running() const { return simulation && !failed; }

    void fail(const Failure& failure) {
        failed = true;
        error = failure.hint.empty() ? failure.message
                                     : fmt::format("{} ({})", failure.message, failure.hint);
    }

    bool start(std::uint32_t k) {
        stage = k;
        if (auto started = simulation->start_stage(k); !started) fail(started.error());
        return !failed;
    }

    /// The checked expression; null, with `error` set, if it has errors.
    const Formula* formula(const std::string& text);

    const Stage& current() const { return script.program->stages[stage]; }
    bool stage_is_done() const {
        const StageState& state = simulation->state(stage);
        return state.done || state.steps >= current().iterations;
    }
    bool is_last_stage() const { return stage + 1 == script.program->stages.size(); }

    /// Takes steps within the current stage. True while there is more to do.
    bool advance(std::int64_t& left) {
        const std::int64_t before = simulation->state(stage).steps;
        const std::int64_t last = std::min(current().iterations, before + left);
        auto end = simulation->advance_stage(stage, last, control, {});
        left -= simulation->state(stage).steps - before;
        if (!end) fail(end.error());
        return end && *end != StageEnd::cancelled;
    }

    /// Are all values of the present step finite? Fails as the steps would have where not.
    bool check() {
        control.cancel = control.checks_later = false;
        if (simulation->state(stage).steps == 0 || stage_is_done()) return true;
        std::int64_t none = 0;
        return advance(none);
    }
};

Pattern::Pattern(const std::string& text, const PatternOptions& options)
    : self_(std::make_unique<Implementation>()) {
    self_->script = load_script(options.name, text, options.folder);
    if (!self_->script.program) return;
    if (self_->script.program->stages.empty()) {
        self_->fail({"this script has no stage to run", example_of_stage(*self_->script.program)});
        return;
    }
    SimulationOptions simulation;
    simulation.backend =
        options.native_code && has_jit() ? BackendKind::jit : BackendKind::interpreter;
    simulation.threads = options.threads;
    auto created = Simulation::create(self_->script, simulation);
    if (!created) {
        self_->fail(created.error());
        return;
    }
    self_->simulation = std::move(*created);
    self_->start(0);
}

Pattern::~Pattern() = default;
Pattern::Pattern(Pattern&&) noexcept = default;
Pattern& Pattern::operator=(Pattern&&) noexcept = default;

bool Pattern::ok() const { return self_->running() && !self_->script.diagnostics.has_errors(); }

std::vector<Message> Pattern::diagnostics() const {
    std::vector<Message> messages;
    const Sources& sources = self_->script.sources;
    for (const Diagnostic& diagnostic : self_->script.diagnostics.sorted()) {
        const Source& source = sources[diagnostic.span.source];
        const Location place = source.locate(diagnostic.span.begin);
        messages.push_back({diagnostic.severity == Severity::error, source.name(),
                            static_cast<int>(place.line), static_cast<int>(place.column),
                            diagnostic.message, diagnostic.hint});
    }
    return messages;
}

std::string Pattern::messages() const { return self_->script.messages(false); }
std::string Pattern::error() const { return self_->error; }

std::int64_t Pattern::width() const {
    if (const auto model = self_->model()) return static_cast<std::int64_t>(model->count());
    return self_->script.program ? self_->script.program->domain.grid.width : 0;
}
std::int64_t Pattern::height() const {
    if (self_->model()) return 1;
    return self_->script.program ? self_->script.program->domain.grid.height : 0;
}
std::int64_t Pattern::depth() const {
    return self_->script.program ? self_->script.program->domain.grid.depth : 0;
}

std::vector<std::string> Pattern::stages() const {
    std::vector<std::string> names;
    if (!self_->script.program) return names;
    for (const Stage& stage : self_->script.program->stages) names.push_back(stage.name);
    return names;
}

std::vector<std::string> Pattern::species(const std::string& stage) const {
    std::vector<std::string> names;
    if (!self_->script.program) return names;
    const Program& program = *self_->script.program;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (program.stages[k].name != stage) continue;
        for (const Quantity& quantity : program.system_of(k).quantities) {
            if (quantity.is_species) names.push_back(quantity.name);
        }
    }
    return names;
}

std::int64_t Pattern::step(std::int64_t count) {
    if (!self_->running()) return 0;
    self_->control.cancel = false;
    self_->control.checks_later = true;
    std::int64_t left = std::max<std::int64_t>(count, 0);
    while (!self_->failed) {
        if (!self_->stage_is_done() && left > 0 && !self_->advance(left)) break;
        if (!self_->stage_is_done() || self_->is_last_stage()) break;
        if (!self_->start(self_->stage + 1)) break;
    }
    // Fewer than none where a value that is not finite takes back steps of earlier calls.
    return std::max<std::int64_t>(std::max<std::int64_t>(count, 0) - left, 0);
}

bool Pattern::finished() const {
    return self_->running() && self_->is_last_stage() && self_->stage_is_done();
}

std::string Pattern::current_stage() const {
    return self_->simulation ? self_->current().name : "";
}
std::int64_t Pattern::steps() const {
    return self_->simulation ? self_->simulation->state(self_->stage).steps : 0;
}

const Formula* Pattern::Implementation::formula(const std::string& text) {
    // The same text in another stage is another expression.
    const std::string key = current().name + ":" + text;
    if (const auto known = formulas.find(key); known != formulas.end()) return &known->second;
    const SourceId source = script.sources.add("<values>", text);
    Diagnostics errors;
    std::optional<Formula> checked;
    if (const auto expression = parse_expression(source, script.sources, script.tree, errors)) {
        checked = check_view(script.tree, *expression, stage, stage, *script.program,
                             script.sources, errors);
    }
    if (checked && checked->nodes.back().type != ValueType::number) {
        errors.error(checked->nodes.back().span, "this is not a number");
    }
    if (!checked || errors.has_errors()) {
        error = render(errors, script.sources, {});
        return nullptr;
    }
    return &formulas.emplace(key, std::move(*checked)).first->second;
}

std::vector<float> Pattern::values(const std::string& text) {
    if (!self_->running() || !self_->check()) return {};
    self_->error.clear();
    const Formula* formula = self_->formula(text);
    if (!formula) return {};
    Field field = std::move(self_->simulation->evaluate(*formula, self_->stage)[0]);
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
