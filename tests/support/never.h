// A flag for work that can be cancelled. It is never set.
#pragma once

#include <atomic>

namespace cascade::test {

inline const std::atomic<bool> never = false;

}  // namespace cascade::test
