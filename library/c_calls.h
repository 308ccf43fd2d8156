// The common parts of all functions of include/cascade/cascade_c.h: handles (which are indices of
// tables), errors, and functions that make a call of a Pattern safe.
#pragma once

#include "cascade/cascade.h"
#include "cascade/cascade_c.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace cascade {

/// The pattern behind a handle. Only one call at a time may use it.
struct OwnPattern {
    Pattern pattern;
    std::recursive_mutex turn = {};
    /// Whether a call is under way. Such a call may call back the program, which may then call the
    /// library again.
    bool is_busy = false;
};
/// The view that a handle stands for, and the pattern that it shows.
struct OwnView {
    std::weak_ptr<OwnPattern> of;
    PatternView view;
};

/// All objects of one kind, by the numbers of their handles.
template <typename Handle, typename Thing>
class Handles {
public:
    Handle* add(std::shared_ptr<Thing> thing) {
        const std::lock_guard lock(guard_);
        things_.emplace(++last_, std::move(thing));
        return reinterpret_cast<Handle*>(last_);
    }
    /// The object of a handle. Null if no object has that handle.
    std::shared_ptr<Thing> find(const Handle* handle) {
        const std::lock_guard lock(guard_);
        const auto found = things_.find(reinterpret_cast<std::uintptr_t>(handle));
        return found == things_.end() ? nullptr : found->second;
    }
    std::shared_ptr<Thing> remove(const Handle* handle) {
        const std::lock_guard lock(guard_);
        auto node = things_.extract(reinterpret_cast<std::uintptr_t>(handle));
        return node ? std::move(node.mapped()) : nullptr;
    }

private:
    std::mutex guard_;
    std::uintptr_t last_ = 0;
    std::map<std::uintptr_t, std::shared_ptr<Thing>> things_;
};

// These tables are never destroyed, because threads may still call while the program ends.
inline Handles<cascade_pattern, OwnPattern>& patterns() {
    static auto* const handles = new Handles<cascade_pattern, OwnPattern>;
    return *handles;
}
inline Handles<cascade_view, OwnView>& views() {
    static auto* const handles = new Handles<cascade_view, OwnView>;
    return *handles;
}

/// The error of the last call that failed in this thread.
struct LastError {
    cascade_status status = CASCADE_OK;
    Message problem;
    std::string text;
};
LastError& last_error();

/// These functions record an error and return its status.
cascade_status fail(cascade_status status, std::string message, std::string hint = "");
cascade_status bad_argument(std::string message);
cascade_status no_pattern();
/// Records the error of the pattern's last call.
cascade_status fail(const Pattern& pattern, cascade_status status);
/// Records the error of a pattern that cannot continue, and returns its status.
cascade_status broken(const Pattern& pattern);
/// Records the error of a call that the pattern refused or that ended the run, and returns its
/// status.
cascade_status refused(const Pattern& pattern);

using PatternCall = std::function<cascade_status(Pattern&)>;
/// Makes a call, and turns exceptions into a status. The library throws exceptions if memory is
/// exhausted.
cascade_status guarded(const std::function<cascade_status()>& call);
/// These functions make a call while the pattern is locked. in_turn() takes a pattern, and the
/// other two take a handle. with_run() also fails if the pattern cannot continue.
cascade_status in_turn(OwnPattern& own, const PatternCall& call);
cascade_status with(cascade_pattern* handle, const PatternCall& call);
cascade_status with_run(cascade_pattern* handle, const PatternCall& call);
/// Makes a change by calling `make`, which returns false if the pattern refuses the change. Fails
/// if one of `texts` is null.
cascade_status change(cascade_pattern* handle, std::initializer_list<const char*> texts,
                      const std::function<bool(Pattern&)>& make);

inline std::string text_or_empty(const char* text) { return text == nullptr ? "" : text; }
inline std::string options_or_none(const char* json) { return json == nullptr ? "{}" : json; }
/// A watcher that calls a callback of the caller. Empty if the callback is null.
ProgressWatcher watcher_of(cascade_callback callback, void* user);
/// Returns a string to the caller. It stays valid until the library returns the next string or
/// bytes in the same thread.
cascade_status give_text(const char** to, std::string text);
cascade_status give_bytes(const void** to, std::size_t* count, std::string bytes);

/// Fills a structure of the caller. If the structure comes from an older version of the header,
/// leaves out the members that it lacks.
template <typename Structure>
cascade_status give(Structure* to, Structure from) {
    if (to == nullptr || to->size < sizeof to->size) {
        return bad_argument("a structure is null, or its size is not set");
    }
    from.size = to->size;
    std::memcpy(static_cast<void*>(to), &from, std::min(to->size, sizeof from));
    return CASCADE_OK;
}

}  // namespace cascade
