// What something costs in memory: it is done in a child process that gets no more.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace cascade::test {

/// Runs `action` in a child process that may have `bytes` more than this one has, and returns its
/// text; "died" where the child did. Sanitizers need more than any limit: then there is none.
std::string in_limited_memory(std::uint64_t bytes, const std::function<std::string()>& action);

}  // namespace cascade::test
