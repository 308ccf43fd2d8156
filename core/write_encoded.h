// Writes the result of an encoder. Messages about errors and a lack of memory name the file.
#pragma once

#include "core/enough_memory.h"
#include "core/file.h"
#include "core/result.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace cascade {

/// Writes the bytes of `encode()`, a Result<std::string>, atomically. Fails if `encode` or the
/// writing fails.
template <typename Encode>
Result<void> write_encoded(const std::filesystem::path& path, const Encode& encode) {
    const std::string name = path.string();
    return enough_memory_for(
        [&]() -> Result<void> {
            const Result<std::string> bytes = encode();
            if (bytes) return write_file(path, *bytes);
            return failure(fmt::format("cannot write '{}': {}", name, bytes.error().message),
                           bytes.error().hint);
        },
        fmt::format("cannot write '{}': there is not enough memory", name));
}

}  // namespace cascade
