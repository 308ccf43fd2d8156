// Compiled kernels kept on disk, for the next process that asks for them.
//
// Internal to jit/. Whatever is wrong with a file means that the kernel is not known
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
    /// Bytes of files above which the oldest are removed.
    static constexpr std::uint64_t usual_limit = std::uint64_t{64} << 20;

    /// An empty folder: nothing is kept or found.
    explicit CodeCache(std::filesystem::path folder, std::uint64_t limit = usual_limit)
        : files_(std::move(folder), {".kernel", "CascKrn2", limit}) {}

    /// The image kept under this key. Safe to call from several threads, as is `keep`.
    std::optional<CodeImage> find(std::string_view key) const;

    /// Keeps an image, if it can. The folder, and those above it, are made where they are missing.
    void keep(std::string_view key, const CodeImage& image);

private:
    KeptFiles files_;
};

}  // namespace cascade
