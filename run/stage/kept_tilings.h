// The fastest tilings that runs have found, kept for later stages of the process and, beside
// compiled kernels, on disk for later processes.
//
// The key of a tiling contains everything that determines its speed: this build, the processor, its
// caches, the kernels of the steps, the grid and the number of threads. No result depends on the
// tilings.
#pragma once

#include "core/kept_files.h"
#include "solvers/tiling_memory.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace cascade {

struct FoundTiling {
    Tiling tiling;
    bool is_sure = false;  ///< It was found twice in a row.
    friend bool operator==(const FoundTiling&, const FoundTiling&) = default;
};

class KeptTilings {
public:
    /// `code` identifies the build and the processor. Nothing is kept on disk without a folder or
    /// if `code` is empty.
    KeptTilings(const std::filesystem::path& folder, std::string code);

    /// The tiling that was found twice in a row, by this process or others.
    std::optional<Tiling> find(const std::string& key);
    void keep(const std::string& key, const Tiling& tiling);

    /// The part that all keys have in common: build, processor and caches.
    const std::string& machine() const { return machine_; }

private:
    std::optional<FoundTiling> look_up(const std::string& key);

    std::string machine_;
    KeptFiles files_;
    std::map<std::string, FoundTiling> known_;
};

/// To a line of text and back; nothing for any other text.
std::string text_of(const FoundTiling& found);
std::optional<FoundTiling> found_tiling_of(const std::string& text);

/// The tilings of one stage.
class StageTilings final : public TilingMemory {
public:
    /// `kernels` is a hash of the kernels of the steps of `problem`. `tilings` must outlive this.
    StageTilings(KeptTilings& tilings, const StepProblem& problem, std::uint64_t kernels);

    std::optional<Tiling> find(int threads) override;
    void keep(int threads, const Tiling& tiling) override;

private:
    std::string key(int threads) const;

    KeptTilings& tilings_;
    std::string key_;
};

}  // namespace cascade
