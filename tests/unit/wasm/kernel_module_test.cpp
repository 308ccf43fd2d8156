// WebAssembly modules as bytes: encoded numbers, the frame of a module, and kernels that are
// refused. The results of modules are compared in tests/wasm_agreement_test.sh.
#include "wasm/kernel_module.h"

#include "ir/builder.h"
#include "wasm/bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade::wasm {
namespace {

using ::testing::ElementsAre;

Bytes unsigned_bytes(std::uint64_t number) {
    Bytes bytes;
    append_unsigned(bytes, number);
    return bytes;
}

Bytes signed_bytes(std::int64_t number) {
    Bytes bytes;
    append_signed(bytes, number);
    return bytes;
}

// The examples in section 7.6 of the DWARF standard, which defines LEB128.
TEST(WasmBytes, NumbersTakeSevenBitsAByte) {
    EXPECT_THAT(unsigned_bytes(2), ElementsAre(2));
    EXPECT_THAT(unsigned_bytes(127), ElementsAre(127));
    EXPECT_THAT(unsigned_bytes(128), ElementsAre(0x80, 1));
    EXPECT_THAT(unsigned_bytes(12857), ElementsAre(57 + 0x80, 100));
    EXPECT_THAT(signed_bytes(2), ElementsAre(2));
    EXPECT_THAT(signed_bytes(-2), ElementsAre(0x7e));
    EXPECT_THAT(signed_bytes(127), ElementsAre(127 + 0x80, 0));
    EXPECT_THAT(signed_bytes(-127), ElementsAre(1 + 0x80, 0x7f));
    EXPECT_THAT(signed_bytes(128), ElementsAre(0x80, 1));
    EXPECT_THAT(signed_bytes(-129), ElementsAre(0x7f + 0x80, 0x7e));
}

CellKernel doubling() {
    KernelBuilder builder;
    const ValueId own = builder.field(builder.field_slot("u"));
    builder.result("u", builder.add(own, own));
    return std::move(builder).finish();
}

TEST(WasmModule, ImportsTheMemoryAndExportsOneFunction) {
    const auto module = wasm_module(doubling(), Stencil::plane);
    ASSERT_TRUE(module);
    const std::string text(module->begin(), module->end());
    EXPECT_EQ(text.substr(0, 8), std::string("\0asm\1\0\0\0", 8));
    const std::string imported(
        "\x02\x0f\x01\x03"
        "env\x06memory\x02\0\0",
        17);
    EXPECT_NE(text.find(imported), std::string::npos);
    EXPECT_NE(text.find(std::string("\x07\x07\x01\x03run\0\0", 9)), std::string::npos);
    EXPECT_LT(text.size(), 400u);
}

TEST(WasmModule, ExactKernelsAreLonger) {
    EXPECT_GT(wasm_module(doubling(), Stencil::plane, {true})->size(),
              wasm_module(doubling(), Stencil::plane)->size());
}

TEST(WasmModule, RefusesMultiplyAdd) {
    KernelBuilder builder;
    const ValueId own = builder.field(builder.field_slot("u"));
    builder.result("u", builder.apply(Op::multiply_add, own, own, own));
    const auto module = wasm_module(std::move(builder).finish(), Stencil::plane);
    ASSERT_FALSE(module);
    EXPECT_EQ(module.error().message, "WebAssembly has no multiply-add");
}

TEST(WasmModule, RefusesKernelsThatAreTooLarge) {
    KernelBuilder builder;
    ValueId value = builder.field(builder.field_slot("u"));
    for (int k = 0; k < 20000; ++k) value = builder.add(value, value);
    builder.result("u", value);
    EXPECT_FALSE(wasm_module(std::move(builder).finish(), Stencil::plane));
}

}  // namespace
}  // namespace cascade::wasm
