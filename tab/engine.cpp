// The engine of a page without a server: it runs a session and answers the messages of
// spec/page.md.
//
// Exported functions. All must be called by the one thread of a browser's worker. begin(),
// receive() and turn() may wait for a GPU (tab/host.h). While one waits, no other may be called:
//
// - allocate(size): returns memory for bytes that the next call takes and frees.
// - carry(name, name_size, bytes, size): adds a file that the script may read.
// - begin(name, name_size, text, size, overrides, overrides_size, is_exact): starts the script.
//   `overrides` are written as in pictures. `is_exact` says whether denormal numbers are flushed
//   from now on wherever the native program flushes them. Returns 0 if the run could not start,
//   after telling the page why. A later call replaces the script, and keeps its model if both
//   scripts have the same one.
// - receive(message, size): handles a message of the page.
// - turn(): takes some steps and sends changes to the page. Returns 0 if there is no more work.
#include "core/file.h"
#include "ir/tiered_backend.h"
#include "run/domain/carried_model.h"
#include "run/script/embedded_script.h"
#include "run/session/kept_state.h"
#include "run/session/turns.h"
#include "tab/files.h"
#include "tab/gpu_executor.h"
#include "tab/host.h"
#include "tab/module_backend.h"
#include "view/carried.h"
#include "view/page_answer.h"
#include "view/page_message.h"
#include "view/page_reply.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {
namespace {

void send_text(const std::string& text) { host_send_text(text.data(), text.size()); }

void send_frame(const std::string& bytes) { host_send_frame(bytes.data(), bytes.size()); }

void tell_progress(const Progress& progress) {
    static bool has_told = false;
    if (progress.doing.empty() && !has_told) return;
    has_told = !progress.doing.empty();
    send_text(print_progress(progress));
}

class Engine {
public:
    bool begin(const std::string& name, const std::string& text, const std::string& overrides,
               bool is_exact);
    void receive(std::string_view text);
    bool turn();

private:
    void send_surface();
    void tell_engine(const EngineOfSteps& engine);
    void tell_script() { send_text(print_script(turns_->run())); }

    std::optional<Turns> turns_;
    std::shared_ptr<const Snapshot> newest_;  ///< The snapshot that the page has.
    bool wants_snapshot_ = false;
    bool has_library_ = false;  ///< Whether the page has the library.
    std::uint64_t told_script_ = 0;
    std::optional<EngineOfSteps> told_engine_;
};

bool Engine::begin(const std::string& name, const std::string& text, const std::string& stored,
                   bool is_exact) {
    const auto refuse = [&](Refusal why) {
        send_text(print_answer(0, tl::unexpected(std::move(why)), text));
        return false;
    };
    const auto fail = [&](Failure why) { return refuse({{}, {}, std::move(why)}); };
    auto overrides = overrides_from_json(stored.empty() ? "{}" : stored);
    if (!overrides) return fail(overrides.error());
    Script script = load_script(name, text, "", std::move(*overrides));
    if (!script.program)
        return refuse({std::move(script.diagnostics), std::move(script.sources), {}});
    SimulationOptions options;
    options.threads = 1;
    if (is_exact) make_modules_exact();
    options.stepper = std::make_shared<TieredBackend>(make_module_backend());
    options.executor = on_gpu([this](const EngineOfSteps& engine) { tell_engine(engine); });
    RunControl control;
    control.report = tell_progress;
    if (turns_) {
        const LiveRun& before = turns_->run();
        if (have_same_cells(*before.script().program, *script.program)) {
            options.known_model = before.simulation().domain().shared_model();
        }
    } else if (auto bytes = read_file(carried_model_name, UINT64_MAX);
               bytes && script.program->domain.model) {
        auto model = parse_carried_model(*bytes);
        if (!model) return fail(model.error());
        options.known_model = link_carried_model(*script.program, *std::move(model));
    }
    auto run = LiveRun::begin(std::move(script), options, control);
    if (!run) return refuse(std::move(run.error()));
    if (!turns_) send_text(print_palettes());
    turns_.emplace(std::move(*run));
    return true;
}

void Engine::receive(std::string_view text) {
    auto message = parse_page_message(text);
    if (!message) return send_text(print_failure(0, message.error()));
    const std::uint64_t id = message->id;
    if (std::holds_alternative<NextSnapshot>(message->request)) {
        wants_snapshot_ = true;
    } else if (std::holds_alternative<NamePage>(message->request)) {
        return;  // The engine serves only one page, so it needs no name for the page.
    } else if (std::holds_alternative<AskForSurface>(message->request)) {
        send_surface();
    } else if (const auto* question = std::get_if<PageQuestion>(&message->request)) {
        send_text(print_reply(id, *question, turns_->run()));
    } else if (std::holds_alternative<SaveModel>(message->request)) {
        send_text(print_failure(id, {"a page that runs without the program cannot write models "
                                     "and maps",
                                     "use 'cascade view', or 'cascade run -o NAME.glb' with the "
                                     "script"}));
    } else if (std::holds_alternative<LoadPart>(message->request)) {
        send_text(print_failure(id, {"a page that runs without the program cannot make the cells "
                                     "of models",
                                     "use 'cascade view'"}));
    } else {
        const auto& command = std::get<SessionCommand>(message->request);
        turns_->control().report = tell_progress;
        const auto result = turns_->obey(command);
        turns_->control().report = {};
        tell_progress({});
        send_text(print_answer(id, result, text_of(command)));
    }
}

void Engine::send_surface() {
    if (!newest_ || !newest_->surface) return;
    Team team(1);
    send_frame(print_surface(shown_surface(*newest_->surface, team), newest_->surface_number));
}

void Engine::tell_engine(const EngineOfSteps& engine) {
    if (told_engine_ == engine) return;
    told_engine_ = engine;
    send_text(print_engine(engine.is_gpu ? "WebGPU" : "WebAssembly", engine.about));
}

bool Engine::turn() {
    if (turns_->is_going_on()) {
        const LiveRun& run = turns_->run();
        if (run.script().program->system_of(run.place().stage).cells) {
            tell_engine({false, "the GPU does not move cells that crawl"});
        }
        turns_->take();
    }
    if (wants_snapshot_ && turns_->has_changed() && turns_->is_snapshot_due()) {
        newest_ = turns_->snapshot();
        if (const auto version = version_of_script(*newest_); version != told_script_) {
            told_script_ = version;
            tell_script();
        }
        wants_snapshot_ = false;
        send_frame(print_snapshot(*newest_));
        // Sent last, because a page that receives the library before its first snapshot asks its
        // user to choose a system.
        if (!has_library_) send_text(print_systems());
        has_library_ = true;
    }
    return turns_->is_going_on();
}

Engine& engine() {
    static Engine one;
    return one;
}

/// Takes the bytes in memory that allocate() returned, and frees this memory.
std::string taken(char* bytes, std::size_t size) {
    std::string text(bytes, size);
    delete[] bytes;
    return text;
}

}  // namespace
}  // namespace cascade

using namespace cascade;

extern "C" {

[[clang::export_name("allocate")]] char* engine_allocate(std::size_t size) {
    return new char[size];
}

[[clang::export_name("carry")]] void engine_carry(char* name, std::size_t name_size, char* bytes,
                                                  std::size_t size) {
    carry_file(taken(name, name_size), taken(bytes, size));
}

[[clang::export_name("begin")]] int engine_begin(char* name, std::size_t name_size, char* text,
                                                 std::size_t size, char* overrides,
                                                 std::size_t overrides_size, int is_exact) {
    return engine().begin(taken(name, name_size), taken(text, size),
                          taken(overrides, overrides_size), is_exact != 0);
}

[[clang::export_name("receive")]] void engine_receive(char* message, std::size_t size) {
    engine().receive(taken(message, size));
}

[[clang::export_name("turn")]] int engine_turn() { return engine().turn(); }

}  // extern "C"
