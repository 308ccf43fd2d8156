// Loads by dlopen.
#include "core/late_library.h"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

namespace cascade {
namespace {

[[noreturn]] void stop(const char* file) {
    const char* reason = ::dlerror();
    std::fprintf(stderr, "cascade: a library that it needs, %s, cannot be used: %s\n", file,
                 reason ? reason : "unknown reason");
    std::abort();
}

}  // namespace

LateLibrary::LateLibrary(const char* file)
    : file_(file), handle_(::dlopen(file, RTLD_LAZY | RTLD_LOCAL)) {
    if (!handle_) stop(file_);
}

LateFunction LateLibrary::operator[](const char* name) const {
    void* const address = ::dlsym(handle_, name);
    if (!address) stop(file_);
    return {address};
}

}  // namespace cascade
