// The functions of include/cascade/cascade_c.h. Each calls a function of Pattern.
#include "library/c_calls.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {
namespace {

// These structures were returned to this thread. Their strings stay valid until the thread's next
// call.
thread_local Message given_message;
thread_local PatternParameter given_parameter;

std::optional<PatternOptions> options_of(const cascade_options* given) {
    PatternOptions options;
    if (given == nullptr) return options;
    if (given->size < sizeof given->size) return std::nullopt;
    cascade_options known{};
    std::memcpy(&known, given, std::min(given->size, sizeof known));
    options.native_code = known.interpret == 0;
    options.threads = known.threads;
    if (known.name != nullptr) options.name = known.name;
    if (known.folder != nullptr) options.folder = known.folder;
    if (known.has_seed != 0) options.seed = known.seed;
    if (known.set_count > 0 && known.sets == nullptr) return std::nullopt;
    for (std::size_t k = 0; k < known.set_count; ++k) {
        if (known.sets[k] == nullptr) return std::nullopt;
        options.sets.emplace_back(known.sets[k]);
    }
    return options;
}

cascade_status create(const void* input, const cascade_options* given, cascade_pattern** handle,
                      const std::function<Pattern(const PatternOptions&)>& make) {
    return guarded([&]() -> cascade_status {
        if (handle == nullptr) return bad_argument("the caller gave no memory for the pattern");
        *handle = nullptr;
        if (input == nullptr) return bad_argument("the script is null");
        const auto options = options_of(given);
        if (!options) {
            return bad_argument(
                "the options have no size, or a null pointer where a string is due");
        }
        auto own = std::shared_ptr<OwnPattern>(new OwnPattern{make(*options)});
        const Pattern& pattern = own->pattern;
        *handle = patterns().add(own);
        return pattern.ok() ? CASCADE_OK : broken(pattern);
    });
}

std::string stage_at(const Pattern& pattern, std::int32_t stage) {
    const auto stages = pattern.stages();
    const bool exists = stage >= 0 && static_cast<std::size_t>(stage) < stages.size();
    return exists ? stages[static_cast<std::size_t>(stage)] : std::string();
}
cascade_status no_stage(std::int32_t stage) {
    return bad_argument("there is no stage " + std::to_string(stage) + "; the first is 0");
}
cascade_status no_index(std::size_t index, std::size_t count) {
    return bad_argument("there is no number " + std::to_string(index) + " of " +
                        std::to_string(count));
}

}  // namespace
}  // namespace cascade

using namespace cascade;

int32_t cascade_c_version(void) { return CASCADE_C_VERSION; }
const char* cascade_version(void) { return library_version(); }

cascade_status cascade_last_error(cascade_error* error) {
    const Message& problem = last_error().problem;
    if (error == nullptr || error->size < sizeof error->size) return CASCADE_BAD_ARGUMENT;
    return give(error, {0, last_error().status, problem.line, problem.column, problem.file.c_str(),
                        problem.text.c_str(), problem.hint.c_str()});
}
const char* cascade_last_message(void) { return last_error().text.c_str(); }

cascade_status cascade_create(const char* script, const cascade_options* options,
                              cascade_pattern** pattern) {
    return create(script, options, pattern,
                  [&](const PatternOptions& known) { return Pattern(script, known); });
}
cascade_status cascade_open(const char* path, const cascade_options* options,
                            cascade_pattern** pattern) {
    return create(path, options, pattern,
                  [&](const PatternOptions& known) { return Pattern::open(path, known); });
}
cascade_status cascade_play(const void* session, size_t bytes, const cascade_options* options,
                            cascade_pattern** pattern) {
    return create(session, options, pattern, [&](const PatternOptions& known) {
        return Pattern::play(std::string(static_cast<const char*>(session), bytes), known);
    });
}
cascade_status cascade_free(cascade_pattern* pattern) {
    return guarded([&]() -> cascade_status {
        const auto own = patterns().remove(pattern);
        if (!own) return no_pattern();
        // If another thread is making a call, the pattern exists until that call returns.
        own->pattern.cancel();
        return CASCADE_OK;
    });
}

cascade_status cascade_message_count(cascade_pattern* pattern, size_t* count) {
    return with(pattern, [&](Pattern& of) -> cascade_status {
        if (count == nullptr) return bad_argument("the caller gave no memory for the count");
        *count = of.diagnostics().size();
        return CASCADE_OK;
    });
}
cascade_status cascade_message_at(cascade_pattern* pattern, size_t index,
                                  cascade_message* message) {
    return with(pattern, [&](Pattern& of) -> cascade_status {
        auto all = of.diagnostics();
        if (index >= all.size()) return no_index(index, all.size());
        given_message = std::move(all[index]);
        const Message& its = given_message;
        return give(message, {0, its.is_error, its.line, its.column, its.file.c_str(),
                              its.text.c_str(), its.hint.c_str()});
    });
}
cascade_status cascade_messages(cascade_pattern* pattern, const char** text) {
    return with(pattern, [&](Pattern& of) { return give_text(text, of.messages()); });
}

cascade_status cascade_get_state(cascade_pattern* pattern, cascade_state* state) {
    return with(pattern, [&](Pattern& of) {
        const auto stages = of.stages();
        const auto now = std::find(stages.begin(), stages.end(), of.current_stage());
        const auto stage = now == stages.end() ? 0 : now - stages.begin();
        return give(state,
                    {0, of.width(), of.height(), of.depth(), static_cast<int32_t>(stage),
                     static_cast<int32_t>(stages.size()), of.steps(), of.finished(), of.moment()});
    });
}
cascade_status cascade_stage_name(cascade_pattern* pattern, int32_t stage, const char** name) {
    return with(pattern, [&](Pattern& of) {
        std::string its = stage_at(of, stage);
        return its.empty() ? no_stage(stage) : give_text(name, std::move(its));
    });
}
cascade_status cascade_species_count(cascade_pattern* pattern, int32_t stage, size_t* count) {
    return with(pattern, [&](Pattern& of) -> cascade_status {
        if (count == nullptr) return bad_argument("the caller gave no memory for the count");
        const std::string its = stage_at(of, stage);
        if (its.empty()) return no_stage(stage);
        *count = of.species(its).size();
        return CASCADE_OK;
    });
}
cascade_status cascade_species_name(cascade_pattern* pattern, int32_t stage, size_t index,
                                    const char** name) {
    return with(pattern, [&](Pattern& of) {
        const std::string its = stage_at(of, stage);
        if (its.empty()) return no_stage(stage);
        const auto species = of.species(its);
        return index < species.size() ? give_text(name, species[index])
                                      : no_index(index, species.size());
    });
}

cascade_status cascade_parameter_count(cascade_pattern* pattern, size_t* count) {
    return with(pattern, [&](Pattern& of) -> cascade_status {
        if (count == nullptr) return bad_argument("the caller gave no memory for the count");
        *count = of.parameters().size();
        return CASCADE_OK;
    });
}
cascade_status cascade_parameter_at(cascade_pattern* pattern, size_t index,
                                    cascade_parameter* parameter) {
    return with(pattern, [&](Pattern& of) -> cascade_status {
        auto all = of.parameters();
        if (index >= all.size()) return no_index(index, all.size());
        given_parameter = std::move(all[index]);
        const PatternParameter& its = given_parameter;
        const auto range = its.range.value_or(PatternParameter::Range{0, 0, {}});
        return give(parameter, {0, its.stage.c_str(), its.name.c_str(), its.doc.c_str(),
                                its.is_uniform, its.value, its.range.has_value(), range.low,
                                range.high, range.step.value_or(0)});
    });
}

cascade_status cascade_step(cascade_pattern* pattern, int64_t count, int64_t* taken) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (count < 0) return bad_argument("the number of steps is negative");
        const int64_t steps = of.step(count);
        if (taken != nullptr) *taken = steps;
        if (!of.ok()) return fail(of, CASCADE_FAILED);
        if (steps == count || of.finished()) return CASCADE_OK;
        return fail(CASCADE_CANCELLED, "the steps were cancelled");
    });
}
cascade_status cascade_run(cascade_pattern* pattern, cascade_callback callback, void* user) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (of.run(watcher_of(callback, user))) return CASCADE_OK;
        return of.ok() ? fail(CASCADE_CANCELLED, "the run was cancelled")
                       : fail(of, CASCADE_FAILED);
    });
}
cascade_status cascade_cancel(cascade_pattern* pattern) {
    return guarded([&]() -> cascade_status {
        const auto own = patterns().find(pattern);
        if (!own) return no_pattern();
        own->pattern.cancel();
        return CASCADE_OK;
    });
}

cascade_status cascade_set(cascade_pattern* pattern, const char* name, const char* expression) {
    return change(pattern, {name, expression},
                  [&](Pattern& of) { return of.set(name, std::string(expression)); });
}
cascade_status cascade_set_number(cascade_pattern* pattern, const char* name, double value) {
    return change(pattern, {name}, [&](Pattern& of) { return of.set(name, value); });
}
cascade_status cascade_set_script(cascade_pattern* pattern, const char* script) {
    return change(pattern, {script}, [&](Pattern& of) { return of.set_script(script); });
}
cascade_status cascade_paint(cascade_pattern* pattern, const char* item, const char* expression) {
    return change(pattern, {item, expression},
                  [&](Pattern& of) { return of.paint(item, expression); });
}
cascade_status cascade_set_values(cascade_pattern* pattern, const char* item, const double* values,
                                  size_t count) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (item == nullptr || values == nullptr) return bad_argument("a pointer is null");
        return of.set_values(item, {values, values + count}) ? CASCADE_OK : refused(of);
    });
}
cascade_status cascade_begin_next_stage(cascade_pattern* pattern) {
    return change(pattern, {}, [](Pattern& of) { return of.begin_next_stage(); });
}
cascade_status cascade_undo(cascade_pattern* pattern) {
    return change(pattern, {}, [](Pattern& of) { return of.undo(); });
}
cascade_status cascade_redo(cascade_pattern* pattern) {
    return change(pattern, {}, [](Pattern& of) { return of.redo(); });
}
