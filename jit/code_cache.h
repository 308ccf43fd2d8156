// Compiled kernels kept on disk, for the next process that asks for them.
//
// Internal to jit/. A folder with a file for each kernel. Everything that can be wrong with a file, its
// owner or the folder means that the kernel is not known; nothing here can fail a run. Processes
// may share the folder: files appear under their names whole. A file holds the whole key, so that a
// hash that two kernels have in common does no harm, and a checksum of everything. The checksum
// stands against accidents; against other people stands that the files and the folder must belong to
// the user and nobody else may write to them.
#pragma once

#include "jit/code_image.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

class CodeCache {
public:
    /// Bytes of files above which the oldest are removed.
    static constexpr std::uint64_t usual_limit = std::uint64_t{64} << 20;

    /// An empty folder: nothing is kept or found.
    explicit CodeCache(std::filesystem::path folder, std::uint64_t limit = usual_limit)
        : folder_(std::move(folder)), limit_(limit) {}

    bool is_on() const { return !folder_.empty(); }

    /// The image kept under this key. Safe to call from several threads, as is `keep`.
    std::optional<CodeImage> find(std::string_view key) const;

    /// Keeps an image, if it can. The folder, and those above it, are made where they are missing.
    void keep(std::string_view key, const CodeImage& image);

private:
    std::filesystem::path path_of(std::string_view key) const;
    void remove_oldest() const;

    std::filesystem::path folder_;
    std::uint64_t limit_;
    std::atomic<unsigned> kept_{0};  ///< How many times.
};

}  // namespace cascade
