// A flag that stops no work.
#pragma once

#include <atomic>

namespace cascade::test {

inline const std::atomic<bool> never = false;

}  // namespace cascade::test
