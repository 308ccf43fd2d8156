// Handles and errors of the C functions.
#include "library/c_calls.h"

#include <exception>
#include <new>

namespace cascade {
namespace {

thread_local std::string given;

}  // namespace

LastError& last_error() {
    thread_local LastError error;
    return error;
}

cascade_status fail(cascade_status status, std::string message, std::string hint) {
    std::string text = hint.empty() ? message : message + " (" + hint + ")";
    last_error() = {status, {true, "", 0, 0, std::move(message), std::move(hint)}, std::move(text)};
    return status;
}
cascade_status bad_argument(std::string message) {
    return fail(CASCADE_BAD_ARGUMENT, std::move(message));
}
cascade_status fail(const Pattern& pattern, cascade_status status) {
    last_error() = {status, pattern.problem(), pattern.error()};
    return status;
}
cascade_status broken(const Pattern& pattern) {
    if (!pattern.error().empty()) return fail(pattern, CASCADE_FAILED);
    last_error() = {CASCADE_BAD_SCRIPT, pattern.problem(), pattern.messages()};
    return CASCADE_BAD_SCRIPT;
}
cascade_status refused(const Pattern& pattern) {
    return fail(pattern, pattern.ok() ? CASCADE_REFUSED : CASCADE_FAILED);
}

cascade_status guarded(const std::function<cascade_status()>& call) {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        try {
            return fail(CASCADE_NO_MEMORY, "there is not enough memory");
        } catch (const std::exception&) {
            return CASCADE_NO_MEMORY;
        }
    } catch (const std::exception& error) {
        return fail(CASCADE_FAILED, error.what());
    }
}

cascade_status no_pattern() {
    return fail(CASCADE_BAD_HANDLE, "this is not a pattern, or it has been freed");
}

cascade_status in_turn(OwnPattern& own, const std::function<cascade_status(Pattern&)>& call) {
    const std::lock_guard turn(own.turn);
    if (own.is_busy) return bad_argument("a callback can only cancel its pattern");
    own.is_busy = true;
    const cascade_status status = guarded([&] { return call(own.pattern); });
    own.is_busy = false;
    return status;
}
cascade_status with(cascade_pattern* handle, const std::function<cascade_status(Pattern&)>& call) {
    return guarded([&] {
        const std::shared_ptr<OwnPattern> own = patterns().find(handle);
        return own ? in_turn(*own, call) : no_pattern();
    });
}
cascade_status with_run(cascade_pattern* handle,
                        const std::function<cascade_status(Pattern&)>& call) {
    return with(handle,
                [&](Pattern& pattern) { return pattern.ok() ? call(pattern) : broken(pattern); });
}
cascade_status change(cascade_pattern* handle, std::initializer_list<const char*> texts,
                      const std::function<bool(Pattern&)>& make) {
    return with_run(handle, [&](Pattern& pattern) -> cascade_status {
        for (const char* text : texts) {
            if (text == nullptr) return bad_argument("a string is null");
        }
        return make(pattern) ? CASCADE_OK : refused(pattern);
    });
}

cascade_status give_text(const char** to, std::string text) {
    if (to == nullptr) return bad_argument("the caller gave no memory for a string");
    given = std::move(text);
    *to = given.c_str();
    return CASCADE_OK;
}
cascade_status give_bytes(const void** to, std::size_t* count, std::string bytes) {
    given = std::move(bytes);
    *to = given.data();
    *count = given.size();
    return CASCADE_OK;
}

ProgressWatcher watcher_of(cascade_callback callback, void* user) {
    if (callback == nullptr) return {};
    return [=](const PatternProgress& now) {
        const cascade_progress progress{sizeof progress, now.stage.c_str(), now.stage_number,
                                        now.stage_count, now.step,          now.steps,
                                        now.t,           now.duration,      now.steps_per_second,
                                        now.seconds_left};
        return callback(&progress, user) != 0;
    };
}

}  // namespace cascade
