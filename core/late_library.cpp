// Loads libraries by dlopen().
#include "core/late_library.h"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

namespace cascade {
namespace {

std::string_view take_reason() {
    const char* const reason = ::dlerror();
    return reason ? reason : "unknown reason";
}

[[noreturn]] void stop(const char* file, std::string_view reason) {
    std::fprintf(stderr, "cascade: a library that it needs, %s, cannot be used: %.*s\n", file,
                 static_cast<int>(reason.size()), reason.data());
    std::abort();
}

}  // namespace

LateLibrary::LateLibrary(const char* file)
    : file_(file), handle_(::dlopen(file, RTLD_LAZY | RTLD_LOCAL)) {
    if (handle_) return;
    // The reason contains one of these texts if the loader gets no memory from the system.
    const std::string_view reason = take_reason();
    for (const char* words : {"failed to map segment", "annot allocate memory"}) {
        if (reason.find(words) != std::string_view::npos) throw std::bad_alloc();
    }
    stop(file_, reason);
}

LateFunction LateLibrary::operator[](const char* name) const {
    void* const address = ::dlsym(handle_, name);
    if (!address) stop(file_, take_reason());
    return {address};
}

}  // namespace cascade
