// Object files linked to images, and facts about the processor without LLVM.
#include "ir/builder.h"
#include "jit/code.h"
#include "jit/jit.h"
#include "jit/link_image.h"
#include "jit/processor.h"
#include "jit/target_machine.h"
#include "tests/support/random_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <llvm-c/Target.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/MC/TargetRegistry.h>

#include <cstring>

namespace cascade::test {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

/// A kernel in which constants are read from memory.
CellKernel kernel_with_constants() {
    KernelBuilder builder;
    const ValueId is_small = builder.apply(Op::less, builder.cell_column(), builder.number(7));
    builder.result("r", builder.select(is_small, builder.number(1.5), builder.number(2.25)));
    return std::move(builder).finish();
}

std::string object_of(CodeModule code, llvm::TargetMachine& machine) {
    const auto object = generate(code, machine, CodeForm::object);
    EXPECT_TRUE(object);
    return {object->begin(), object->end()};
}

std::string object_of(const CellKernel& kernel, llvm::TargetMachine& machine) {
    auto code = make_code(kernel, shape_for(kernel, Stencil::plane, widest_lanes(machine)),
                          "kernel", machine);
    EXPECT_TRUE(code);
    return object_of(std::move(*code), machine);
}

std::unique_ptr<llvm::TargetMachine> machine_of_this_host() {
    return std::move(choose_target("", {}).value().machine);
}

/// The machine that choose_target() makes on AArch64.
std::unique_ptr<llvm::TargetMachine> machine_of_aarch64() {
    LLVMInitializeAArch64TargetInfo();
    LLVMInitializeAArch64Target();
    LLVMInitializeAArch64TargetMC();
    LLVMInitializeAArch64AsmPrinter();
    const char* const triple = "aarch64-unknown-linux-gnu";
    std::string error;
    const llvm::Target* target = llvm::TargetRegistry::lookupTarget(triple, error);
    EXPECT_TRUE(target) << error;
    return std::unique_ptr<llvm::TargetMachine>(target->createTargetMachine(
        triple, "neoverse-n1", "", {}, llvm::Reloc::PIC_, llvm::CodeModel::Small));
}

std::uint32_t word_at(const CodeImage& image, std::uint64_t place) {
    std::uint32_t word = 0;
    EXPECT_LE(place + sizeof word, image.bytes.size());
    if (place + sizeof word <= image.bytes.size()) {
        std::memcpy(&word, image.bytes.data() + place, sizeof word);
    }
    return word;
}

/// The words to which AArch64 code refers: ADRP puts their page into a register, and the following
/// ADD or LDR of 16 bytes contains their offset in the page.
std::vector<std::uint32_t> words_read(const CodeImage& image) {
    std::vector<std::uint32_t> words;
    for (std::uint64_t place = image.entry; place < image.bytes.size(); place += 4) {
        const std::uint32_t adrp = word_at(image, place);
        if ((adrp & 0x9f000000) != 0x90000000) continue;
        EXPECT_EQ(adrp & 0x60ffffe0, 0u) << "the image is within one page";
        for (std::uint64_t after = place + 4; after < image.bytes.size(); after += 4) {
            const std::uint32_t word = word_at(image, after);
            const bool is_add = (word & 0xffc00000) == 0x91000000;
            const bool is_load = (word & 0xffc00000) == 0x3dc00000;
            if (!(is_add || is_load) || (word >> 5 & 31) != (adrp & 31)) continue;
            words.push_back(word_at(image, (word >> 10 & 0xfff) * (is_load ? 16 : 1)));
            break;
        }
    }
    return words;
}

TEST(CodeImage, ObjectsOfAllOperationsAreLinked) {
    const auto host = machine_of_this_host(), aarch64 = machine_of_aarch64();
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        RandomKernelOptions options;
        options.operations = 300;
        const CellKernel kernel = random_kernel(seed, options);
        for (llvm::TargetMachine* machine : {host.get(), aarch64.get()}) {
            const auto image = link_image(object_of(kernel, *machine), "kernel");
            ASSERT_TRUE(image) << "seed " << seed << ": " << image.error().message;
            EXPECT_LT(image->entry, image->bytes.size());
        }
    }
}

TEST(CodeImage, UnoptimisedObjectsOfLargeKernelsAreLinked) {
    RandomKernelOptions options;
    options.operations = 3000;
    options.results = 150;
    options.composed_percent = 60;
    std::uint64_t seed = 100;
    CellKernel kernel = random_kernel(seed, options);
    while (kernel.code.size() <= largest_optimised_kernel) kernel = random_kernel(++seed, options);
    for (const auto& machine : {machine_of_this_host(), machine_of_aarch64()}) {
        const auto image = link_image(object_of(kernel, *machine), "kernel");
        EXPECT_TRUE(image) << image.error().message;
    }
}

TEST(CodeImage, CodeOfAarch64FindsItsConstants) {
    const auto machine = machine_of_aarch64();
    const auto image = link_image(object_of(kernel_with_constants(), *machine), "kernel");
    ASSERT_TRUE(image) << image.error().message;
    // 1.5, 2.25 and the first column of a vector, 0.
    EXPECT_THAT(words_read(*image), UnorderedElementsAre(0x3fc00000, 0x40100000, 0));
}

TEST(CodeImage, WhatIsNotInTheObjectIsAFailure) {
    const auto machine = machine_of_this_host();
    const std::string object = object_of(kernel_with_constants(), *machine);
    EXPECT_EQ(link_image(object, "other").error().message,
              "native code could not be linked: there is no function other");
    EXPECT_FALSE(link_image("", "kernel"));
    EXPECT_FALSE(link_image("\177ELF", "kernel"));

    // A call, as LLVM would write one for a function of the C library.
    CodeModule code = make_module(*machine);
    llvm::IRBuilder<> builder(*code.context);
    auto* type = llvm::FunctionType::get(builder.getVoidTy(), false);
    auto* function =
        llvm::Function::Create(type, llvm::Function::ExternalLinkage, "kernel", *code.module);
    builder.SetInsertPoint(llvm::BasicBlock::Create(*code.context, "", function));
    builder.CreateCall(code.module->getOrInsertFunction("sinf", type));
    builder.CreateRetVoid();
    EXPECT_EQ(link_image(object_of(std::move(code), *machine), "kernel").error().message,
              "native code could not be linked: it refers to sinf");
}

TEST(CodeImage, CodeThatDependsOnItsAddressIsAFailure) {
    for (const auto& machine : {machine_of_this_host(), machine_of_aarch64()}) {
        CodeModule code = make_module(*machine);
        llvm::IRBuilder<> builder(*code.context);
        auto* type = llvm::FunctionType::get(builder.getPtrTy(), false);
        auto* function =
            llvm::Function::Create(type, llvm::Function::ExternalLinkage, "kernel", *code.module);
        auto* pointer = new llvm::GlobalVariable(*code.module, builder.getPtrTy(), false,
                                                 llvm::GlobalValue::PrivateLinkage, function);
        builder.SetInsertPoint(llvm::BasicBlock::Create(*code.context, "", function));
        builder.CreateRet(builder.CreateLoad(builder.getPtrTy(), pointer));
        EXPECT_EQ(link_image(object_of(std::move(code), *machine), "kernel").error().message,
                  "native code could not be linked: it depends on where it lies");
    }
}

TEST(CodeImage, LoadedFunctionsRun) {
    // mov eax, 42; ret
#if defined(__x86_64__)
    const auto loaded = LoadedFunction::load({std::string("\xcc\xb8\x2a\x00\x00\x00\xc3", 7), 1});
    ASSERT_TRUE(loaded);
    EXPECT_EQ((*loaded)->as<int()>()(), 42);
#endif
}

TEST(Processor, VectorsAreThoseThatLlvmKnows) {
    EXPECT_THAT(describe_jit(), HasSubstr(std::to_string(host_lanes()) + " cells a vector"));
    EXPECT_EQ(host_identity(), host_identity());
}

TEST(Processor, CoresOfArmAreToldApartByTheirKinds) {
    const std::string little = "Features\t: fp asimd\nCPU part\t: 0xd03\n";
    const std::string big = "Features\t: fp asimd crc32\nCPU part\t: 0xd08\n";
    const auto core = [](int number, const std::string& lines) {
        return "processor\t: " + std::to_string(number) + "\nBogoMIPS\t: 3.1\n" + lines + "\n";
    };
    EXPECT_EQ(kinds_of_cores(core(0, little)), "CPU part\t: 0xd03|Features\t: fp asimd");
    EXPECT_EQ(kinds_of_cores(core(0, little) + core(1, little)), kinds_of_cores(core(0, little)));
    EXPECT_NE(kinds_of_cores(core(0, little) + core(1, big)), kinds_of_cores(core(0, little)));
    EXPECT_EQ(kinds_of_cores(""), "") << "nothing is kept for a processor that is not known";
}

}  // namespace
}  // namespace cascade::test
