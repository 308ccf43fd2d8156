// Stores compiled kernels on disk, so that later processes need not compile them.
//
// Internal to jit/. A file that is damaged or cannot be read counts as absent (core/kept_files.h).
#pragma once

#include "core/kept_files.h"
#include "jit/code_image.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace cascade {

class CodeCache {
public:
    /// The usual limit, in bytes. If all files together are larger than the limit, the oldest are
    /// removed.
    static constexpr std::uint64_t usual_limit = std::uint64_t{64} << 20;

    /// If `folder` is empty, find() finds no kernels and keep() does nothing.
    explicit CodeCache(std::filesystem::path folder, std::uint64_t limit = usual_limit)
        : files_(std::move(folder), {".kernel", "CascKrn2", limit}) {}

    /// The image stored under this key. Both find() and keep() are thread-safe.
    std::optional<CodeImage> find(std::string_view key) const;

    /// Stores an image if possible. Creates folders that do not exist.
    void keep(std::string_view key, const CodeImage& image);

private:
    KeptFiles files_;
};

}  // namespace cascade
