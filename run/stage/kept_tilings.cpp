// A tiling is stored as one line of numbers. Once two searches in a row have found the same tiling,
// there is no further search.
#include "run/stage/kept_tilings.h"

#include "core/cache_sizes.h"
#include "core/version.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

namespace cascade {

namespace {

constexpr KeptFiles::Kind tiling_files{".tiling", "CascTil1", std::uint64_t{1} << 20};

}  // namespace

KeptTilings::KeptTilings(const std::filesystem::path& folder, std::string code)
    : machine_(fmt::format("{}|{}|{}|{}|", version(), CacheSizes::here().second,
                           CacheSizes::here().third, code)),
      files_(code.empty() ? std::filesystem::path() : folder, tiling_files) {}

std::optional<FoundTiling> KeptTilings::look_up(const std::string& key) {
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    const auto text = files_.find(key);
    return text ? found_tiling_of(*text) : std::nullopt;
}

std::optional<Tiling> KeptTilings::find(const std::string& key) {
    const auto found = look_up(key);
    return found && found->is_sure ? std::optional(found->tiling) : std::nullopt;
}

void KeptTilings::keep(const std::string& key, const Tiling& tiling) {
    const auto before = look_up(key);
    const FoundTiling found{tiling, before && before->tiling == tiling};
    if (found == before) return;
    known_[key] = found;
    files_.keep(key, text_of(found));
}

std::string text_of(const FoundTiling& found) {
    const Tiling& tiling = found.tiling;
    return fmt::format("{} {} {} {} {:d} {} {:d}", tiling.levels, tiling.outer_layer,
                       tiling.inner_layer, tiling.inner_bands, tiling.is_near,
                       static_cast<unsigned>(tiling.along), found.is_sure);
}

std::optional<FoundTiling> found_tiling_of(const std::string& text) {
    std::istringstream words(text);
    FoundTiling found;
    Tiling& tiling = found.tiling;
    unsigned along = 0;
    words >> tiling.levels >> tiling.outer_layer >> tiling.inner_layer >> tiling.inner_bands;
    words >> tiling.is_near >> along >> found.is_sure;
    if (!words) return std::nullopt;
    tiling.along = static_cast<Tiling::Along>(along);
    return found;
}

StageTilings::StageTilings(KeptTilings& tilings, const StepProblem& problem, std::uint64_t kernels)
    : tilings_(tilings) {
    const Grid& grid = problem.grid;
    key_ = fmt::format("{}{:016x}, {} passes, {}x{}x{}{}, {} bytes, wraps {:d}{:d}{:d}",
                       tilings.machine(), kernels, problem.passes.size(), grid.width, grid.height,
                       grid.depth, grid.linked ? " linked" : "", bytes_of_step(problem),
                       wraps(problem, Side::left), wraps(problem, Side::top),
                       wraps(problem, Side::front));
}

std::string StageTilings::key(int threads) const {
    return fmt::format("{}, {} threads", key_, threads);
}

std::optional<Tiling> StageTilings::find(int threads) { return tilings_.find(key(threads)); }

void StageTilings::keep(int threads, const Tiling& tiling) { tilings_.keep(key(threads), tiling); }

}  // namespace cascade
