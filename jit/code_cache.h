// Compiled kernels stored on disk for later processes.
//
// Internal to jit/. If anything is wrong with a file, the kernel counts as unknown
// (core/kept_files.h).
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
    /// Above this number of bytes, the oldest files are removed.
    static constexpr std::uint64_t usual_limit = std::uint64_t{64} << 20;

    /// With an empty folder, stores and finds no kernels.
    explicit CodeCache(std::filesystem::path folder, std::uint64_t limit = usual_limit)
        : files_(std::move(folder), {".kernel", "CascKrn2", limit}) {}

    /// The image stored under this key. Thread-safe, as is `keep`.
    std::optional<CodeImage> find(std::string_view key) const;

    /// Stores an image if possible. Creates missing folders.
    void keep(std::string_view key, const CodeImage& image);

private:
    KeptFiles files_;
};

}  // namespace cascade
