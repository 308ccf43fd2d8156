// Stores the fastest tilings that runs have found. They are stored in memory for later stages of
// this process, and in the folder of compiled kernels for later processes.
//
// The key of a tiling contains everything that affects its speed: this build, the processor, its
// caches, the kernels of the steps, the grid and the number of threads. No result depends on
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
    /// Whether two searches in a row have found this tiling. If so, there is no further search.
    bool is_sure = false;
    friend bool operator==(const FoundTiling&, const FoundTiling&) = default;
};

class KeptTilings {
public:
    /// `code` identifies the build and the processor. Tilings are stored on disk only if neither
    /// `folder` nor `code` is empty.
    KeptTilings(const std::filesystem::path& folder, std::string code);

    /// Returns the tiling that two searches in a row have found, in this process or in others.
    /// Returns an empty optional if there is no such tiling.
    std::optional<Tiling> find(const std::string& key);
    void keep(const std::string& key, const Tiling& tiling);

    /// The part that all keys share, which identifies the build, the processor and its caches.
    const std::string& machine() const { return machine_; }

private:
    std::optional<FoundTiling> look_up(const std::string& key);

    std::string machine_;
    KeptFiles files_;
    std::map<std::string, FoundTiling> known_;
};

/// text_of() converts a found tiling to a line of text, and found_tiling_of() converts it back. For
/// any other text, the result is an empty optional.
std::string text_of(const FoundTiling& found);
std::optional<FoundTiling> found_tiling_of(const std::string& text);

/// The stored tilings of one stage.
class StageTilings final : public TilingMemory {
public:
    /// `kernels` is a hash of the kernels of the steps of `problem`. `tilings` must outlive this
    /// object.
    StageTilings(KeptTilings& tilings, const StepProblem& problem, std::uint64_t kernels);

    std::optional<Tiling> find(int threads) override;
    void keep(int threads, const Tiling& tiling) override;

private:
    std::string key(int threads) const;

    KeptTilings& tilings_;
    std::string key_;
};

}  // namespace cascade
