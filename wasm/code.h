// A sequence of WebAssembly's instructions, as bytes.
//
// Internal to wasm/. WebAssembly computes on a stack: an instruction takes its operands from the
// top and leaves its result there. Locals store values that are needed more than once.
#pragma once

#include "core/precision.h"
#include "ir/word_format.h"
#include "wasm/bytes.h"
#include "wasm/instructions.h"

#include <cstdint>

namespace cascade::wasm {

/// A parameter or local variable of the function.
enum class Local : std::uint32_t {};

class Code {
public:
    explicit Code(Precision precision) : precision_(precision) {}

    const Bytes& bytes() const { return bytes_; }
    void clear() { bytes_.clear(); }

    void write(Plain instruction) { bytes_.push_back(static_cast<std::uint8_t>(instruction)); }
    void write(Whole instruction) { write_vector(static_cast<std::uint8_t>(instruction)); }
    void write(Lanes instruction) {
        const LaneCodes codes = codes_of(instruction);
        write_vector(precision_ == Precision::single ? codes.single : codes.binary64);
    }
    void write(const Code& other) { append(bytes_, other.bytes_); }
    /// Writes an instruction that works on one lane.
    void write(Lanes instruction, int lane) {
        write(instruction);
        bytes_.push_back(static_cast<std::uint8_t>(lane));
    }

    void get(Local local) { with_index(Plain::get, local); }
    void set(Local local) { with_index(Plain::set, local); }
    void tee(Local local) { with_index(Plain::tee, local); }

    void integer(std::int32_t value) {
        write(Plain::constant);
        append_signed(bytes_, value);
    }
    /// Pushes a vector with the same word in all lanes, or with a word that grows by `growth` from
    /// lane to lane.
    void vector(std::uint64_t word, std::uint64_t growth = 0) {
        write(Whole::constant);
        const int bytes = static_cast<int>(bytes_of(precision_));
        for (int k = 0; k < vector_bytes; ++k) {
            if (k > 0 && k % bytes == 0) word += growth;
            bytes_.push_back(static_cast<std::uint8_t>(word >> (8 * (k % bytes))));
        }
    }

    void call(std::size_t function) {
        write(Plain::call);
        append_unsigned(bytes_, function);
    }

    /// Writes a load or store at `offset` bytes after the address on the stack.
    template <typename Instruction>
    void access(Instruction instruction, std::uint32_t offset) {
        const bool is_half = is_of_16_bits(instruction);
        write(instruction);
        append_unsigned(bytes_, is_half ? 1 : 2);  // The binary logarithm of the alignment.
        append_unsigned(bytes_, offset);
    }
    /// Writes a load or store of one lane.
    void access(Lanes instruction, std::uint32_t offset, int lane) {
        access(instruction, offset);
        bytes_.push_back(static_cast<std::uint8_t>(lane));
    }

    /// Opens a block or a loop. A branch goes to the end of a block, or to the start of a loop.
    void open(Plain block_or_loop) {
        constexpr std::uint8_t no_value = 0x40;
        write(block_or_loop);
        bytes_.push_back(no_value);
    }
    void close() { write(Plain::end); }
    /// Branches out of the innermost block, or to the start of the innermost loop, if the top of
    /// the stack is not 0.
    void branch_if() {
        write(Plain::branch_if);
        append_unsigned(bytes_, 0);
    }

    static constexpr int vector_bytes = 16;

private:
    static constexpr bool is_of_16_bits(Plain code) { return code == Plain::load_16_signed; }
    static constexpr bool is_of_16_bits(Whole code) { return code == Whole::load_16_splat; }
    static constexpr bool is_of_16_bits(Lanes) { return false; }

    void write_vector(std::uint8_t code) {
        constexpr std::uint8_t prefix = 0xfd;
        bytes_.push_back(prefix);
        append_unsigned(bytes_, code);
    }
    void with_index(Plain instruction, Local local) {
        write(instruction);
        append_unsigned(bytes_, static_cast<std::uint32_t>(local));
    }

    Precision precision_;
    Bytes bytes_;
};

}  // namespace cascade::wasm
