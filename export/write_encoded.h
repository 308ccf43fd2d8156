// Writing what an encoder makes, with its faults and a lack of memory told with the file's name.
#pragma once

#include "core/file.h"
#include "core/result.h"

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <string>

namespace cascade {

/// Writes the bytes that `encode()` gives, a Result<std::string>, atomically. Fails as it and
/// write_file do.
template <typename Encode>
Result<void> write_encoded(const std::filesystem::path& path, const Encode& encode) {
    try {
        const Result<std::string> bytes = encode();
        if (bytes) return write_file(path, *bytes);
        return failure(fmt::format("cannot write '{}': {}", path.string(), bytes.error().message),
                       bytes.error().hint);
    } catch (const std::bad_alloc&) {
        return failure(fmt::format("cannot write '{}': there is not enough memory", path.string()));
    }
}

}  // namespace cascade
