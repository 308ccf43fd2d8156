// Printed kernels and the interpreter compute the same bits: random kernels that reach every
// operation, hostile numbers, lines, planes, volumes and linked cells, both precisions, and both
// ways to flush denormal numbers.
#include "ir/builder.h"
#include "ir/interpreter.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/new_seed.h"
#include "tests/support/random_kernels.h"
#include "tests/unit/device/kernels_on_device.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>
#include <vector>

namespace cascade::test {
namespace {

/// Where kernels are compared.
struct Place {
    Grid grid;
    Precision precision = Precision::single;
    Flushing flushing = Flushing::by_device;
};

std::vector<Place> places() {
    Grid linked{37, 4};
    linked.linked = true;
    const Grid plane{67, 5, Boundary::periodic}, volume{35, 4, Boundary::no_flux, 3};
    std::vector<Place> all{{Grid{50, 1}}, {Grid{1, 40}}};
    for (const Precision precision : {Precision::single, Precision::binary64}) {
        for (const Flushing flushing : {Flushing::by_device, Flushing::by_kernel}) {
            for (const Grid& grid : {plane, volume, linked}) {
                all.push_back({grid, precision, flushing});
            }
        }
    }
    return all;
}

/// Compares many kernels, each with hostile inputs of its own.
void compare(const std::vector<CellKernel>& kernels, const Place& place, std::uint64_t seed) {
    OpenDevice& device = tested_device();
    const TextTarget target{place.precision, place.flushing, device.facts().has_fast_fma, false};
    const KernelsOnDevice on_device(device, kernels, place.grid, target);
    const auto interpreter = make_interpreter();
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const HostileInputs inputs(kernels[k], place.grid, seed + k);
        const auto expected = inputs.run(**interpreter->compile(kernels[k], place.grid.stencil()));
        const auto found = inputs.run(*on_device.kernel(k));
        ASSERT_EQ(same_bits(expected, found), "") << fmt::format("kernel {} of seed {}\n", k, seed)
                                                  << print(kernels[k]) << on_device.source();
        ASSERT_EQ(stray_writes(found, {0, PlaneLayout(place.grid).row_count()}), "");
    }
}

/// Compares at least `count` random kernels of `operations` operations at each place.
void compare_random_kernels(std::uint64_t first_seed, std::uint64_t count, int operations) {
    OperationCounts on_grids, on_links;
    std::uint64_t seed = first_seed;
    for (const Place& place : places()) {
        std::vector<CellKernel> kernels;
        // Linked cells have more operations, and fewer places.
        const std::uint64_t here = place.grid.linked ? 4 * count : count;
        for (std::uint64_t k = 0; k < here; ++k, ++seed) {
            RandomKernelOptions options;
            options.precision = place.precision;
            options.links = place.grid.linked;
            options.link_planes = false;  // All planes of a kernel here have one size.
            options.operations = operations;
            // With more results, fewer operations are removed as unused.
            options.results = 1 + operations / 5;
            options.composed_percent = seed % 4 == 0 ? 4 : 0;
            kernels.push_back(random_kernel(seed, options));
            (place.grid.linked ? on_links : on_grids).add(kernels.back());
        }
        compare(kernels, place, seed);
        if (::testing::Test::HasFatalFailure()) return;
    }
    if (first_seed != 1) return;
    EXPECT_EQ(on_grids.missing(), "");
    EXPECT_EQ(on_links.missing(true, false), "");
}

TEST(PrintedKernels, HaveTheInterpretersBits) { compare_random_kernels(1, 1, 250); }

/// Kernels from new seeds. CASCADE_DEVICE_KERNELS is the smallest number of kernels at each place.
TEST(PrintedKernels, FromNewSeeds) {
    const char* const wanted = std::getenv("CASCADE_DEVICE_KERNELS");
    if (wanted == nullptr) GTEST_SKIP() << "tests/heavy/device_kernels_test.sh runs it";
    const std::uint64_t count = std::strtoull(wanted, nullptr, 10);
    constexpr std::uint64_t of_program = 20;
    for (std::uint64_t done = 0; done < count; done += of_program) {
        compare_random_kernels(test::new_seed() + 1000 * done + 2, of_program, 40);
        if (::testing::Test::HasFatalFailure()) return;
    }
}

TEST(PrintedKernels, OthersDiffer) {
    KernelBuilder first, second;
    first.result("r", first.add(first.field(first.field_slot("a")), first.number(1)));
    second.result("r", second.subtract(second.field(second.field_slot("a")), second.number(1)));
    const CellKernel one = std::move(first).finish(), other = std::move(second).finish();
    const Grid grid{20, 3};
    const TextTarget target{Precision::single, Flushing::by_device, true, false};
    const HostileInputs inputs(one, grid, 1);
    const KernelsOnDevice on_device(tested_device(), {one}, grid, target);
    EXPECT_NE(same_bits(inputs.run(*on_device.kernel(0)),
                        run_kernel(*make_interpreter(), other, grid, 1)),
              "");
}

}  // namespace
}  // namespace cascade::test
