// Kernels of many results: how they are divided, and that dividing changes no bit.
#include "ir/kernel_parts.h"

#include "ir/builder.h"
#include "ir/interpreter.h"
#include "jit/jit.h"
#include "tests/support/kernel_comparison.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace cascade::test {
namespace {

enum class Coupling { none, ring, all };

struct Family {
    std::size_t species = 0;
    Coupling coupling = Coupling::none;
    bool stores_rates = false;  ///< Whether the rates are results after the new values.
    Precision precision = Precision::single;
};

/// A step of species that diffuse and react.
CellKernel kernel_of(const Family& family) {
    KernelBuilder builder(family.precision);
    const auto slot = [&](std::size_t k) {
        return builder.field_slot(fmt::format("u{}", k % family.species));
    };
    const ValueId step = builder.uniform(builder.uniform_slot("step"));
    ValueId all = builder.number(0);
    for (std::size_t k = 0; k < family.species; ++k) all = builder.add(all, builder.field(slot(k)));
    std::vector<ValueId> rates;
    for (std::size_t k = 0; k < family.species; ++k) {
        const ValueId own = builder.field(slot(k));
        const ValueId spread = builder.uniform(builder.uniform_slot(fmt::format("d{}", k)));
        ValueId factor = own;
        if (family.coupling == Coupling::ring) factor = builder.field(slot(k + 1));
        if (family.coupling == Coupling::all) factor = all;
        rates.push_back(builder.add(builder.multiply(spread, builder.laplacian(slot(k))),
                                    builder.multiply(own, factor)));
    }
    for (std::size_t k = 0; k < family.species; ++k) {
        builder.result(fmt::format("u{}", k),
                       builder.add(builder.field(slot(k)), builder.multiply(step, rates[k])));
    }
    for (std::size_t k = 0; family.stores_rates && k < family.species; ++k) {
        builder.result(fmt::format("r{}", k), rates[k]);
    }
    return std::move(builder).finish();
}

TEST(KernelParts, FewResultsAreOnePartAsItWas) {
    const CellKernel kernel = kernel_of({most_results_of_a_part, Coupling::ring});
    const std::vector<KernelPart> parts = parts_of(kernel);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].kernel.code, kernel.code);
    EXPECT_EQ(parts[0].kernel.results, kernel.results);
    EXPECT_FALSE(parts[0].is_in_order);
}

TEST(KernelParts, EachResultIsInOneOfPartsOfEqualSize) {
    for (const std::size_t species : {9u, 16u, 17u, 64u, 100u}) {
        SCOPED_TRACE(species);
        const std::vector<KernelPart> parts = parts_of(kernel_of({species, Coupling::ring}));
        std::vector<std::size_t> results;
        for (const KernelPart& part : parts) {
            EXPECT_EQ(verify(part.kernel), "");
            EXPECT_EQ(part.kernel.results.size(), part.results.size());
            EXPECT_LE(part.results.size(), most_results_of_a_part);
            EXPECT_GE(part.results.size() + 1, species / parts.size());
            results.insert(results.end(), part.results.begin(), part.results.end());
        }
        EXPECT_EQ(parts.size(), (species + most_results_of_a_part - 1) / most_results_of_a_part);
        std::sort(results.begin(), results.end());
        for (std::size_t k = 0; k < results.size(); ++k) EXPECT_EQ(results[k], k);
        EXPECT_EQ(results.size(), species);
    }
}

// If they were divided, each part would have to add up all species again.
TEST(KernelParts, ResultsThatShareMostOfTheirWorkStayTogether) {
    const std::vector<KernelPart> parts = parts_of(kernel_of({64, Coupling::all}));
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_TRUE(parts[0].is_in_order);
    EXPECT_TRUE(std::is_sorted(parts[0].kernel.results.begin(), parts[0].kernel.results.end()));
}

TEST(KernelParts, RatesThatAreStoredAreWithTheirSpecies) {
    const std::vector<KernelPart> parts = parts_of(kernel_of({32, Coupling::ring, true}));
    ASSERT_EQ(parts.size(), 8u);
    for (const KernelPart& part : parts) {
        for (const std::size_t result : part.results) {
            EXPECT_NE(std::find(part.results.begin(), part.results.end(), (result + 32) % 64),
                      part.results.end());
        }
    }
}

TEST(KernelParts, GiveTheBitsOfTheWhole) {
    const auto interpreter = make_interpreter();
    for (const int lanes : {4, 8, 16}) {
        const auto jit = make_jit({lanes, 2});
        ASSERT_TRUE(jit);
        for (const Coupling coupling : {Coupling::none, Coupling::ring, Coupling::all}) {
            for (const bool stores_rates : {false, true}) {
                const auto precision = stores_rates ? Precision::binary64 : Precision::single;
                const CellKernel kernel = kernel_of({19, coupling, stores_rates, precision});
                Grid linked{40, 3};
                linked.linked = true;
                for (const Grid& grid : {Grid{150, 4}, Grid{20, 3, {}, 3}, Grid{70, 1}, linked}) {
                    EXPECT_EQ(same_bits(run_kernel(*interpreter, kernel, grid, 3),
                                        run_kernel(**jit, kernel, grid, 3)),
                              "");
                }
            }
        }
    }
}

}  // namespace
}  // namespace cascade::test
