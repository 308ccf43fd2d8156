// What runs found out about tilings, kept for later stages of the process and, beside compiled
// kernels, on disk for later processes.
//
// A tiling is found again by all that decides how fast it is: this build, the processor, its
// caches, the kernels of the steps, the grid and the number of threads. No result depends on what
// is found.
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
    /// Without a folder, or where `code`, all that decides code besides kernels, is not known and
    /// empty, nothing is kept on disk.
    KeptTilings(const std::filesystem::path& folder, std::string code);

    /// What was kept twice in a row, by this process or others.
    std::optional<Tiling> find(const std::string& key);
    void keep(const std::string& key, const Tiling& tiling);

    /// What decides all keys: build, processor and caches.
    const std::string& machine() const { return machine_; }

private:
    std::optional<FoundTiling> look_up(const std::string& key);

    std::string machine_;
    KeptFiles files_;
    std::map<std::string, FoundTiling> known_;
};

/// As a line of text, and back; nothing where the text is another.
std::string text_of(const FoundTiling& found);
std::optional<FoundTiling> found_tiling_of(const std::string& text);

/// Those of one stage.
class StageTilings final : public TilingMemory {
public:
    /// `kernels`: a hash of what the steps of `problem` run. `tilings` must outlive it.
    StageTilings(KeptTilings& tilings, const StepProblem& problem, std::uint64_t kernels);

    std::optional<Tiling> find(int threads) override;
    void keep(int threads, const Tiling& tiling) override;

private:
    std::string key(int threads) const;

    KeptTilings& tilings_;
    std::string key_;
};

}  // namespace cascade
