// What the functions of include/cascade/cascade_c.h share: handles, which are numbers in tables,
// faults, and the ways to call a Pattern.
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

/// A pattern of a handle. Calls take turns.
struct OwnPattern {
    Pattern pattern;
    std::recursive_mutex turn = {};
    bool is_busy = false;  ///< A call is under way, which may have called back.
};
/// A view of a handle, and the pattern that it was opened of.
struct OwnView {
    std::weak_ptr<OwnPattern> of;
    PatternView view;
};

/// What handles of one kind stand for.
template <typename Handle, typename Thing>
class Handles {
public:
    Handle* add(std::shared_ptr<Thing> thing) {
        const std::lock_guard lock(guard_);
        things_.emplace(++last_, std::move(thing));
        return reinterpret_cast<Handle*>(last_);
    }
    /// Null if there is none.
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

// Never destroyed, since threads may still call while the program ends.
inline Handles<cascade_pattern, OwnPattern>& patterns() {
    static auto* const handles = new Handles<cascade_pattern, OwnPattern>;
    return *handles;
}
inline Handles<cascade_view, OwnView>& views() {
    static auto* const handles = new Handles<cascade_view, OwnView>;
    return *handles;
}

/// The fault of a thread's last call that failed.
struct LastError {
    cascade_status status = CASCADE_OK;
    Message problem;
    std::string text;
};
LastError& last_error();

/// Note a fault, and return its status.
cascade_status fail(cascade_status status, std::string message, std::string hint = "");
cascade_status bad_argument(std::string message);
cascade_status no_pattern();
/// The fault of a pattern's last call.
cascade_status fail(const Pattern& pattern, cascade_status status);
/// The status of a pattern that is not ok.
cascade_status broken(const Pattern& pattern);
/// After a call that has been refused, or has ended the run.
cascade_status refused(const Pattern& pattern);

using PatternCall = std::function<cascade_status(Pattern&)>;
/// Turns exceptions, which the library throws where memory is short, into a status.
cascade_status guarded(const std::function<cascade_status()>& call);
/// Calls with a pattern, in turn; with that of a handle; with one that is ok.
cascade_status in_turn(OwnPattern& own, const PatternCall& call);
cascade_status with(cascade_pattern* handle, const PatternCall& call);
cascade_status with_run(cascade_pattern* handle, const PatternCall& call);
/// The same for calls that take effect or are refused. None of `texts` may be null.
cascade_status change(cascade_pattern* handle, std::initializer_list<const char*> texts,
                      const std::function<bool(Pattern&)>& make);

inline std::string text_or_empty(const char* text) { return text == nullptr ? "" : text; }
/// Gives a string, which stays valid until the thread's next one.
cascade_status give_text(const char** to, std::string text);
cascade_status give_bytes(const void** to, std::size_t* count, std::string bytes);

/// Fills a structure of the caller, as much of it as the caller knows.
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
