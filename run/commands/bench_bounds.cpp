// Uses the roofline model (S. Williams, A. Waterman, D. Patterson, CACM 52(4), 2009). The work of a
// step is divided by the measured peak speed of the machine: by the speed of its arithmetic, and by
// the bandwidth of each cache and memory.
#include "core/check.h"
#include "run/commands/bench.h"

#include <algorithm>

namespace cascade {

namespace {

/// Returns the cache or memory that holds the layers of all threads together. Returns null if steps
/// are not computed in tiles.
const MachineLimits::Memory* cache_of_tiles(const StageBench& bench) {
    const double bytes = bench.stepping.bytes_in_use * bench.threads;
    return bytes > 0 ? &bench.limits->home_of(bytes) : nullptr;
}

/// Returns the bytes that a step of one cell moves to and from `home`. Several sweeps of a tile
/// need a single move, so the bytes are divided among the sweeps.
double home_bytes(const StageBench& bench) {
    return bench.work.bytes / bench.stepping.sweeps_at_once;
}

}  // namespace

std::vector<Bound> bounds_of(const StageBench& bench) {
    std::vector<Bound> bounds;
    if (!bench.limits || bench.step <= 0) return bounds;
    const MachineLimits& limits = *bench.limits;
    const StepWork& work = bench.work;
    const double rate = bench.cell_steps_per_second();
    using Kind = Bound::Kind;
    bounds.push_back(
        {Kind::operations, "arithmetic", rate * work.cost.operations, limits.operations});
    if (work.cost.divisions > 0) {
        bounds.push_back(
            {Kind::divisions, "divisions and roots", rate * work.cost.divisions, limits.divisions});
    }
    const auto& nearest = limits.memories.front();
    bounds.push_back({Kind::nearest, "loads and stores, " + nearest.name,
                      rate * (work.cost.load_bytes + work.cost.store_bytes),
                      nearest.bytes_per_second});
    const auto& home = limits.home_of(work.working_set);
    const auto* const tiles = cache_of_tiles(bench);
    if (tiles != nullptr && tiles != &nearest) {
        bounds.push_back(
            {Kind::tiles, "tiles, " + tiles->name, rate * work.bytes, tiles->bytes_per_second});
    }
    if (&home != &nearest) {
        bounds.push_back(
            {Kind::home, "planes, " + home.name, rate * home_bytes(bench), home.bytes_per_second});
    }
    if (bench.threads > 1 && limits.meeting > 0) {
        bounds.push_back({Kind::meetings, "meetings of threads",
                          bench.stepping.meetings / bench.step, 1 / limits.meeting});
    }
    return bounds;
}

bool is_outdone(const Bound& bound) {
    constexpr double most = 1.1;
    return bound.share() > most;
}

const Bound& tightest(const std::vector<Bound>& bounds) {
    CHECK(!bounds.empty(), "there are limits");
    const auto weight = [](const Bound& bound) { return is_outdone(bound) ? -1 : bound.share(); };
    return *std::max_element(bounds.begin(), bounds.end(),
                             [&](const Bound& a, const Bound& b) { return weight(a) < weight(b); });
}

std::optional<Roof> attainable(const StageBench& bench) {
    if (!bench.limits) return std::nullopt;
    const StepWork& work = bench.work;
    const auto& home = bench.limits->home_of(work.working_set);
    Roof roof{home.bytes_per_second / home_bytes(bench), home.name};
    const auto lower = [&](double cell_steps, const std::string& name) {
        if (cell_steps < roof.cell_steps_per_second) roof = {cell_steps, name};
    };
    if (const auto* const tiles = cache_of_tiles(bench)) {
        lower(tiles->bytes_per_second / work.bytes, tiles->name);
    }
    if (work.cost.operations > 0)
        lower(bench.limits->operations / work.cost.operations, "arithmetic");
    return roof;
}

}  // namespace cascade
