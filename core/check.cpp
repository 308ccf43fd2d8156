// Reports a failed CHECK.
#include "core/check.h"

#include <cstdio>
#include <cstdlib>

namespace cascade {

void check_failed(const char* file, int line, const char* condition, const char* why) {
    std::fprintf(stderr, "cascade: internal error at %s:%d: %s\n    which must hold: %s\n", file,
                 line, why, condition);
    std::fflush(stderr);
    std::abort();
}

}  // namespace cascade
