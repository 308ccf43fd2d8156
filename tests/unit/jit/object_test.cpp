// Object files: a symbol with the wanted name, and no undefined symbols.
#include "ir/builder.h"
#include "ir/interpreter.h"
#include "ir/multiply_add.h"
#include "jit/jit.h"
#include "jit/link_image.h"
#include "tests/support/kernel_comparison.h"
#include "tests/support/random_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <span>

#if defined(__x86_64__) && defined(__linux__)
#include <elf.h>

namespace cascade::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Symbols {
    std::vector<std::string> defined_functions;
    std::vector<std::string> undefined;
    bool ok = false;
};

template <typename T>
T read_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
    T value{};
    if (offset + sizeof value <= bytes.size()) {
        std::memcpy(&value, bytes.data() + offset, sizeof value);
    }
    return value;
}

/// The symbol table of an ELF file of 64 bits.
Symbols symbols_of(std::span<const std::uint8_t> bytes) {
    Symbols symbols;
    const auto header = read_at<Elf64_Ehdr>(bytes, 0);
    if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0 || header.e_type != ET_REL) {
        return symbols;
    }
    const auto section = [&](std::size_t number) {
        return read_at<Elf64_Shdr>(bytes, header.e_shoff + number * sizeof(Elf64_Shdr));
    };
    for (std::size_t number = 0; number < header.e_shnum; ++number) {
        const Elf64_Shdr table = section(number);
        if (table.sh_type != SHT_SYMTAB) continue;
        symbols.ok = true;
        const Elf64_Shdr names = section(table.sh_link);
        for (std::size_t at = sizeof(Elf64_Sym); at < table.sh_size; at += sizeof(Elf64_Sym)) {
            const auto symbol = read_at<Elf64_Sym>(bytes, table.sh_offset + at);
            const char* name =
                reinterpret_cast<const char*>(bytes.data()) + names.sh_offset + symbol.st_name;
            const bool is_function = ELF64_ST_TYPE(symbol.st_info) == STT_FUNC;
            if (is_function && ELF64_ST_BIND(symbol.st_info) == STB_GLOBAL) {
                symbols.defined_functions.emplace_back(name);
            }
            if (symbol.st_shndx == SHN_UNDEF) symbols.undefined.emplace_back(name);
        }
    }
    return symbols;
}

/// An object file of one function.
Result<std::vector<std::uint8_t>> object_of(const CellKernel& kernel, Stencil stencil,
                                            const std::string& name, const std::string& target) {
    return compile_object({{{name, kernel}}}, stencil, target);
}

/// A kernel with every operation of the table, except those that only some targets have.
CellKernel kernel_with_all_operations() {
    for (std::uint64_t seed = 1;; ++seed) {
        RandomKernelOptions options;
        options.multiply_adds = false;
        options.operations = 500;
        options.results = 60;
        const CellKernel kernel = random_kernel(seed, options);
        OperationCounts counts;
        counts.add(kernel);
        const std::string missing = counts.missing();
        if (missing.empty() || missing == "multiply_add") return kernel;
    }
}

TEST(JitObject, HoldsTheFunctionAndNeedsNothing) {
    const CellKernel kernel = kernel_with_all_operations();
    for (const std::string target :
         {"", "x86-64", "x86-64-v2", "x86-64-v3", "x86-64-v4", "znver4", "haswell"}) {
        for (const Stencil stencil : {Stencil::row, Stencil::column, Stencil::plane}) {
            const auto object = object_of(kernel, stencil, "my_step", target);
            ASSERT_TRUE(object) << object.error().message;
            const Symbols symbols = symbols_of(*object);
            ASSERT_TRUE(symbols.ok) << target;
            EXPECT_THAT(symbols.defined_functions, ElementsAre("my_step")) << target;
            EXPECT_THAT(symbols.undefined, IsEmpty()) << target;
        }
    }
}

/// An object file's function as a kernel.
template <typename Number = float>
class ObjectKernel final : public Kernel {
public:
    ObjectKernel(const std::vector<std::uint8_t>& object, const std::string& name) {
        const auto* bytes = reinterpret_cast<const char*>(object.data());
        const auto image = link_image({bytes, object.size()}, name);
        EXPECT_TRUE(image) << (image ? "" : image.error().message);
        if (image) function_ = std::move(LoadedFunction::load(*image).value());
    }

    using Kernel::run;
    void run(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const override {
        if (!function_) return;
        const ColumnRange columns = cells.columns.within(arguments.layout.width);
        using Function = void(const Number* const*, const std::uint8_t* const*, const Number*,
                              Number* const*, std::int64_t, std::int64_t, std::int64_t,
                              std::int64_t, std::int64_t, std::int64_t);
        function_->template as<Function>()(arguments.fields.data(), arguments.masks.data(),
                                           arguments.uniforms.data(), arguments.results.data(),
                                           columns.begin, columns.end, arguments.layout.stride,
                                           cells.rows.begin, cells.rows.end, arguments.is_near);
    }

private:
    std::unique_ptr<LoadedFunction> function_;
};

std::vector<std::string> targets_of_this_machine() {
    std::vector<std::string> targets{"", "x86-64"};
    if (__builtin_cpu_supports("sse4.2")) targets.emplace_back("x86-64-v2");
    if (__builtin_cpu_supports("avx2")) targets.emplace_back("x86-64-v3");
    if (__builtin_cpu_supports("avx512vl")) targets.emplace_back("x86-64-v4");
    return targets;
}

// Code for different processors gives the same bits, and operations without an instruction on a
// processor are refused.
TEST(JitObject, AllTargetsComputeTheSameBits) {
    const auto interpreter = make_interpreter();
    int number = 0, compared = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const CellKernel kernel = random_kernel(seed + 200000);
        const Grid grid = random_grid(seed, 40, 4);
        const std::vector<Field> expected = run_kernel(*interpreter, kernel, grid, seed);
        for (const std::string& target : targets_of_this_machine()) {
            const std::string name = "step" + std::to_string(number++);
            const auto object = object_of(kernel, grid.stencil(), name, target);
            if (multiplies_and_adds(kernel) && (target == "x86-64" || target == "x86-64-v2")) {
                EXPECT_FALSE(object);
                continue;
            }
            ++compared;
            ASSERT_TRUE(object) << object.error().message;
            const ObjectKernel native(*object, name);
            ASSERT_EQ(same_bits(expected, HostileInputs(kernel, grid, seed).run(native)), "")
                << "target '" << target << "', seed " << seed;
        }
    }
    EXPECT_GT(compared, 80);
}

TEST(JitObject, CodeDependsOnTheTarget) {
    RandomKernelOptions options;
    options.multiply_adds = false;  // The plain target has no such instruction.
    const CellKernel kernel = random_kernel(3, options);
    const auto plain = object_of(kernel, Stencil::plane, "f", "x86-64");
    const auto wide = object_of(kernel, Stencil::plane, "f", "x86-64-v4");
    ASSERT_TRUE(plain && wide);
    EXPECT_NE(*plain, *wide);
    EXPECT_EQ(*plain, *object_of(kernel, Stencil::plane, "f", "x86-64"));
}

TEST(JitObject, WrongRequestsAreFailures) {
    const CellKernel kernel = random_kernel(3);
    const auto object = object_of(kernel, Stencil::plane, "f", "pentium-pro-max");
    ASSERT_FALSE(object);
    EXPECT_THAT(object.error().message, HasSubstr("pentium-pro-max"));
    for (const char* name : {"", "9lives", "a b", "a-b", "é"}) {
        EXPECT_FALSE(object_of(kernel, Stencil::plane, name, "")) << name;
    }
}

TEST(JitObject, MultiplyAddsAreForTargetsThatHaveThem) {
    if (known_targets().empty()) GTEST_SKIP() << "only kinds of x86-64 can be chosen";
    KernelBuilder builder;
    const ValueId a = builder.field(builder.field_slot("a"));
    builder.result("r", builder.apply(Op::multiply_add, a, a, a));
    const CellKernel kernel = std::move(builder).finish();
    for (const char* target : {"x86-64", "x86-64-v2"}) {
        const auto refused = object_of(kernel, Stencil::plane, "f", target);
        ASSERT_FALSE(refused) << target;
        EXPECT_EQ(refused.error().message, "the processor " + std::string(target) +
                                               " cannot multiply and add with one "
                                               "rounding, as --fast requires");
    }
    const auto object = object_of(kernel, Stencil::plane, "f", "x86-64-v3");
    ASSERT_TRUE(object) << object.error().message;
    EXPECT_THAT(symbols_of(*object).undefined, IsEmpty());
}

TEST(JitObject, TargetsAreNamed) {
    if (known_targets().empty()) GTEST_SKIP() << "only kinds of x86-64 can be chosen";
    for (const char* target : {"x86-64", "x86-64-v2", "x86-64-v3", "x86-64-v4", "znver4"}) {
        EXPECT_THAT(known_targets(), Contains(target));
    }
    EXPECT_THAT(known_targets(), ::testing::Not(Contains("i386")));
}

TEST(JitObject, KernelsForLinkedCellsAreRefused) {
    KernelBuilder builder;
    builder.result("r", builder.laplacian(builder.field_slot("a")));
    const auto made = compile_object({{{"r", std::move(builder).finish()}}}, Stencil::linked, "");
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("cells of a model"), std::string::npos);
}

}  // namespace
}  // namespace cascade::test
#endif
