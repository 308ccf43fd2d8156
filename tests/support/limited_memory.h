// Tests how much memory an action needs: it runs in a child process with limited memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace cascade::test {

/// Runs `action` in a child process that may use `bytes` bytes more than this process. Returns what
/// `action` returned, or "died" if the child died. With sanitizers there is no limit, since they
/// need more than any limit.
std::string in_limited_memory(std::uint64_t bytes, const std::function<std::string()>& action);

}  // namespace cascade::test
