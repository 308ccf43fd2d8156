// Object files linked to images, and what is told of the processor without LLVM.
#include "core/hash.h"
#include "ir/builder.h"
#include "jit/code_image.h"
#include "jit/generator.h"
#include "jit/processor.h"
#include "tests/support/random_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::testing {
namespace {

std::string object_of(std::uint64_t seed, int operations = 80) {
    RandomKernelOptions options;
    options.operations = operations;
    const auto generator = code_generator();
    EXPECT_TRUE(generator);
    const auto object =
        (*generator)->compile(random_kernel(seed, options), {Stencil::plane, host_lanes()}, 2);
    EXPECT_TRUE(object);
    return *object;
}

#if defined(__x86_64__) && defined(__linux__)

TEST(CodeImage, ObjectsOfAllOperationsAreLinked) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto image = link_image(object_of(seed, 300), kernel_function_name);
        ASSERT_TRUE(image) << "seed " << seed;
        EXPECT_LT(image->entry, image->bytes.size());
    }
}

TEST(CodeImage, OtherNamesAndOtherFilesAreNot) {
    const std::string object = object_of(1);
    EXPECT_FALSE(link_image(object, "other"));
    EXPECT_FALSE(link_image("", kernel_function_name));
    EXPECT_FALSE(link_image("\177ELF", kernel_function_name));
    EXPECT_FALSE(link_image(std::string(4096, '\0'), kernel_function_name));
}

TEST(CodeImage, DamagedObjectsAreReadWithinTheirBytes) {
    const std::string object = object_of(2);
    for (std::size_t n = 0; n < object.size(); n += 7) {
        (void)link_image(std::string_view(object).substr(0, n), kernel_function_name);
    }
    int refused = 0;
    for (std::uint32_t k = 0; k < 3000; ++k) {
        const auto random = pcg4d({k, 7, 8, 9});
        std::string damaged = object;
        // Headers and tables are at the ends, code between them.
        const std::size_t place =
            random[3] % 2 ? random[0] % 64 : damaged.size() - 1 - random[0] % 700;
        damaged[place] = static_cast<char>(random[1]);
        const auto image = link_image(damaged, kernel_function_name);
        refused += !image;
        EXPECT_TRUE(!image || image->entry < image->bytes.size());
    }
    EXPECT_GT(refused, 100);
}

#endif

TEST(CodeImage, LoadedFunctionsRun) {
    // mov eax, 42; ret
#if defined(__x86_64__)
    const auto loaded = load_image({std::string("\xcc\xb8\x2a\x00\x00\x00\xc3", 7), 1});
    ASSERT_TRUE(loaded);
    EXPECT_EQ((*loaded)->as<int()>()(), 42);
#endif
}

TEST(CodeGenerator, OrcLoadsTheSameObjects) {
    const auto generator = code_generator();
    ASSERT_TRUE(generator);
    const auto function = (*generator)->load(object_of(1));
    ASSERT_TRUE(function);
    EXPECT_NE((*function)->address, 0u);
}

TEST(Processor, VectorsAreThoseThatLlvmKnows) {
    EXPECT_THAT(describe_jit(),
                ::testing::HasSubstr(std::to_string(host_lanes()) + " cells a vector"));
    EXPECT_EQ(host_identity(), host_identity());
}

}  // namespace
}  // namespace cascade::testing
