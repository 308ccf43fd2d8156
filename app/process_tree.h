// The processes that a process has started, as /proc lists them.
#pragma once

#include <sys/types.h>

namespace cascade {

/// Whether a process has children, and every descendant is one of two kinds: it has ended and its
/// parent has not waited for it, or it only waits for such processes. False if /proc does not list
/// children.
bool only_ended_below(pid_t process);

}  // namespace cascade
