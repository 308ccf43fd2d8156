// Measures three kernels on planes that fill each cache: twelve independent chains of sums and
// products, divisions, and a triad (a + s · b). Each measurement is repeated, and the best result
// counts.
#include "run/commands/machine_limits.h"

#include "core/cache_sizes.h"
#include "core/floating_point.h"
#include "core/parallel.h"
#include "core/plane.h"
#include "ir/builder.h"
#include "ir/kernel_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <memory>

namespace cascade {

namespace {

using Clock = std::chrono::steady_clock;

std::string level_name(int number) {
    constexpr std::array names = {"first", "second", "third", "fourth"};
    const int at = std::clamp(number, 1, static_cast<int>(names.size())) - 1;
    return fmt::format("{}-level cache", names[static_cast<std::size_t>(at)]);
}

/// Returns the caches of this machine or, if they are unknown, caches with the sizes that are
/// common in present processors.
std::vector<CacheLevel> known_caches() {
    std::vector<CacheLevel> levels = cache_levels();
    if (levels.empty()) levels = {{1, 32 << 10, 1}, {2, 512 << 10, 1}, {3, 8 << 20, 1}};
    return levels;
}

/// Makes a kernel of twelve chains of sums and products, whose results are added at the end. The
/// chains are independent, so the processor can compute them at the same time.
CellKernel arithmetic_kernel(Precision precision) {
    KernelBuilder builder(precision);
    const ValueId x = builder.field(builder.field_slot("x"));
    const ValueId half = builder.uniform(builder.uniform_slot("half"));
    std::array<ValueId, 12> chains{};
    for (std::size_t k = 0; k < chains.size(); ++k) {
        chains[k] = builder.multiply(x, builder.number(1.0 / static_cast<double>(k + 2)));
    }
    constexpr int rounds = 16;
    for (int round = 0; round < rounds; ++round) {
        for (ValueId& chain : chains) chain = builder.multiply(builder.add(chain, half), half);
    }
    ValueId sum = chains[0];
    for (std::size_t k = 1; k < chains.size(); ++k) sum = builder.add(sum, chains[k]);
    builder.result("r", sum);
    return std::move(builder).finish();
}

CellKernel division_kernel(Precision precision) {
    KernelBuilder builder(precision);
    const ValueId x = builder.field(builder.field_slot("x"));
    ValueId sum = x;
    for (int k = 0; k < 8; ++k) {
        const ValueId divisor = builder.add(x, builder.number(1.0 + k));
        sum = builder.add(sum, builder.divide(builder.number(1.5), divisor));
    }
    builder.result("r", sum);
    return std::move(builder).finish();
}

CellKernel triad_kernel(Precision precision) {
    KernelBuilder builder(precision);
    const ValueId a = builder.field(builder.field_slot("a"));
    const ValueId b = builder.field(builder.field_slot("b"));
    const ValueId s = builder.uniform(builder.uniform_slot("s"));
    builder.result("r", builder.add(a, builder.multiply(s, b)));
    return std::move(builder).finish();
}

/// Measures the time of kernels on a team of threads, each with separate planes. Of several
/// measurements, the best counts.
template <typename Number>
class Meter {
public:
    Meter(Team& team, const std::atomic<bool>& cancel) : team_(team), cancel_(cancel) {}

    /// Measures how many cells all threads together compute in a second. Each thread has planes of
    /// `columns` × `rows` cells.
    double cells_per_second(const Kernel& kernel, std::size_t fields, std::int64_t columns,
                            std::int64_t rows) {
        Grid grid;
        grid.width = columns;
        grid.height = rows;
        const PlaneLayout layout(grid);
        std::vector<std::vector<Plane<Number>>> planes(static_cast<std::size_t>(team_.size()));
        for (auto& of_thread : planes) {
            for (std::size_t k = 0; k <= fields; ++k) of_thread.emplace_back(layout);
        }
        // Each thread fills its own planes, so that the memory is allocated near its processor.
        team_.run([&](int thread) {
            for (auto& plane : planes[static_cast<std::size_t>(thread)]) fill(plane);
        });
        std::int64_t times = 1;
        double best = 0;
        for (int turn = 0, good = 0; good < most_turns && turn < 40 && !cancel_; ++turn) {
            const double seconds = time([&](int thread) {
                repeat(kernel, planes[static_cast<std::size_t>(thread)], layout, times);
            });
            if (seconds < least_seconds && times < (std::int64_t{1} << 40)) {
                const double factor =
                    std::clamp(1.3 * least_seconds / std::max(seconds, 1e-9), 2.0, 64.0);
                times = static_cast<std::int64_t>(static_cast<double>(times) * factor);
                continue;
            }
            const double cells = static_cast<double>(columns * rows * times) * team_.size();
            best = std::max(best, cells / seconds);
            ++good;
        }
        return best;
    }

    /// Measures the seconds that a barrier of all threads takes.
    double meeting() {
        if (team_.size() == 1) return 0;
        constexpr int times = 2000;
        double best = std::numeric_limits<double>::infinity();
        for (int turn = 0; turn < most_turns && !cancel_; ++turn) {
            const double seconds = time([&](int) {
                for (int k = 0; k < times; ++k) team_.barrier();
            });
            best = std::min(best, seconds / times);
        }
        return best;
    }

private:
    /// Measures the seconds that `work` takes. All threads begin it at the same time.
    template <typename Work>
    double time(Work work) {
        Clock::time_point begin, end;
        team_.run([&](int thread) {
            team_.barrier();
            if (thread == 0) begin = Clock::now();
            work(thread);
            team_.barrier();
            if (thread == 0) end = Clock::now();
        });
        return std::chrono::duration<double>(end - begin).count();
    }

    static void fill(Plane<Number>& plane) {
        const PlaneLayout& layout = plane.layout();
        for (std::int64_t row = 0; row < layout.row_count(); ++row) {
            std::fill_n(plane.row(row), layout.width, Number(0.75));
        }
    }

    static void repeat(const Kernel& kernel, std::vector<Plane<Number>>& planes,
                       const PlaneLayout& layout, std::int64_t times) {
        std::vector<const Number*> fields;
        for (const auto& plane : planes) fields.push_back(plane.origin());
        fields.pop_back();
        Number* const result = planes.back().origin();
        const Number uniform = Number(0.5);
        KernelArgumentsOf<Number> arguments;
        arguments.fields = fields;
        arguments.uniforms = {&uniform, 1};
        arguments.results = {&result, 1};
        arguments.layout = layout;
        for (std::int64_t k = 0; k < times; ++k) kernel.run(arguments, {0, layout.row_count()});
    }

    static constexpr double least_seconds = 0.004;
    static constexpr int most_turns = 5;

    Team& team_;
    const std::atomic<bool>& cancel_;
};

template <typename Number>
Result<MachineLimits> limits_with(Backend& backend, int threads, const std::atomic<bool>& cancel) {
    constexpr Precision precision = precision_of<Number>;
    const auto compile = [&](const CellKernel& kernel) {
        return backend.compile(kernel, Stencil::plane);
    };
    const CellKernel arithmetic = arithmetic_kernel(precision),
                     division = division_kernel(precision);
    const auto sums = compile(arithmetic), quotients = compile(division);
    const auto triad = compile(triad_kernel(precision));
    for (const auto* const made : {&sums, &quotients, &triad}) {
        if (!*made) return tl::unexpected(made->error());
    }
    Team team(threads);
    Meter<Number> meter(team, cancel);
    MachineLimits limits;
    limits.threads = threads;
    constexpr std::int64_t columns = 512;
    limits.operations = meter.cells_per_second(**sums, 1, columns, 1) *
                        cost_of(arithmetic, Stencil::plane, 0).operations;
    limits.divisions = meter.cells_per_second(**quotients, 1, columns, 1) *
                       cost_of(division, Stencil::plane, 0).divisions;
    limits.meeting = meter.meeting();

    constexpr double planes = 3;
    const auto bandwidth = [&](double bytes_of_thread) {
        const double cells = bytes_of_thread / (planes * sizeof(Number));
        const double width = std::clamp(cells, 64.0, 1024.0);
        const double speed = meter.cells_per_second(
            **triad, 2, static_cast<std::int64_t>(width),
            std::max<std::int64_t>(1, static_cast<std::int64_t>(cells / width)));
        return speed * planes * sizeof(Number);
    };
    double largest = 0;
    for (const CacheLevel& level : known_caches()) {
        // Cores that share a cache share its capacity. If a cache is not shared, each core has one.
        const auto caches = static_cast<double>(std::max<std::int64_t>(1, threads / level.cores));
        const auto bytes = static_cast<double>(level.bytes) * caches;
        largest = std::max(largest, bytes);
        limits.memories.push_back(
            {level_name(level.number), bytes, bandwidth(bytes / 2 / threads)});
    }
    constexpr double least = 64e6, most = 512e6;
    const double beyond = std::clamp(4 * largest, least, most);
    limits.memories.push_back(
        {"memory", std::numeric_limits<double>::infinity(), bandwidth(beyond / threads)});
    if (cancel) return failure("stopped while the machine was measured");
    return limits;
}

}  // namespace

const MachineLimits::Memory& MachineLimits::home_of(double bytes) const {
    for (const Memory& memory : memories) {
        if (bytes <= memory.bytes) return memory;
    }
    return memories.back();
}

Result<MachineLimits> measure_limits(Backend& backend, Precision precision, int threads,
                                     const std::atomic<bool>& cancel) {
    return with_number(precision, [&](auto zero) {
        return limits_with<decltype(zero)>(backend, threads, cancel);
    });
}

}  // namespace cascade
