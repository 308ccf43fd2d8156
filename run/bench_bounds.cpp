#include "core/check.h"
#include "run/bench.h"

#include <algorithm>
#include <limits>

namespace cascade {

namespace {

/// Planes that are found in cache more often than the counting knows may reach a little more.
constexpr double most_of_home = 1.1;

}  // namespace

std::vector<Bound> bounds_of(const StageBench& bench) {
    std::vector<Bound> bounds;
    if (!bench.limits || bench.step <= 0) return bounds;
    const MachineLimits& limits = *bench.limits;
    const StepWork& work = bench.work;
    const double rate = bench.cell_steps_per_second();
    using Kind = Bound::Kind;
    bounds.push_back({Kind::operations, "arithmetic", rate * work.cost.operations, limits.operations});
    if (work.cost.divisions > 0) {
        bounds.push_back({Kind::divisions, "divisions and roots", rate * work.cost.divisions,
                          limits.divisions});
    }
    const auto& nearest = limits.memories.front();
    bounds.push_back({Kind::nearest, "loads and stores, " + nearest.name,
                      rate * (work.cost.load_bytes + work.cost.store_bytes),
                      nearest.bytes_per_second});
    const auto& home = limits.home_of(work.working_set);
    if (&home != &nearest) {
        bounds.push_back({Kind::home, "planes, " + home.name, rate * work.bytes, home.bytes_per_second});
    }
    if (bench.threads > 1 && limits.meeting > 0) {
        bounds.push_back({Kind::meetings, "meetings of threads",
                          static_cast<double>(work.meetings) / bench.step, 1 / limits.meeting});
    }
    return bounds;
}

const Bound& tightest(const std::vector<Bound>& bounds) {
    CHECK(!bounds.empty(), "there are limits");
    const auto weight = [](const Bound& bound) {
        const bool is_outdone = bound.kind == Bound::Kind::home && bound.share() > most_of_home;
        return is_outdone ? -1 : bound.share();
    };
    return *std::max_element(bounds.begin(), bounds.end(), [&](const Bound& a, const Bound& b) {
        return weight(a) < weight(b);
    });
}

double attainable(const StageBench& bench) {
    if (!bench.limits) return 0;
    const StepWork& work = bench.work;
    const double bandwidth = bench.limits->home_of(work.working_set).bytes_per_second;
    double most = std::numeric_limits<double>::infinity();
    if (work.cost.operations > 0) most = bench.limits->operations / work.cost.operations;
    return std::min(most, bandwidth / work.bytes);
}

}  // namespace cascade
