// A WebAssembly function while it is written: its locals, its constants, and the code of each loop
// level.
//
// Internal to wasm/. Each loop level has its own code, so that while the code of cells is written,
// values that are the same in all cells can still be added before the loops.
#pragma once

#include "ir/loop_levels.h"
#include "ir/word_format.h"
#include "wasm/code.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace cascade::wasm {

enum class LocalType : std::uint8_t { vector = 0x7b, integer = 0x7f };

class Function {
public:
    /// All parameters are 32-bit integers.
    Function(Precision precision, std::uint32_t parameters)
        : precision_(precision),
          parameters_(parameters),
          codes_{Code(precision), Code(precision), Code(precision), Code(precision)} {}

    Precision precision() const { return precision_; }
    WordFormat format() const { return format_of(precision_); }
    int number_bytes() const { return static_cast<int>(bytes_of(precision_)); }
    /// The binary logarithm of number_bytes().
    int number_shift() const { return precision_ == Precision::single ? 2 : 3; }
    int lanes() const { return Code::vector_bytes / number_bytes(); }

    Code& at(LoopLevel level) { return codes_[static_cast<std::size_t>(level)]; }

    /// A local that code of this level may write.
    Local take(LoopLevel level, LocalType type = LocalType::vector);
    /// Releases a local, so that take() at the same level can return it again. Only for the levels
    /// of cells and links. Locals of outer levels keep their values for all cells.
    void give_back(Local local, LoopLevel level = LoopLevel::cell);
    /// Moves the top of the stack to a new local.
    Local keep(LoopLevel level, LocalType type = LocalType::vector) {
        const Local local = take(level, type);
        at(level).set(local);
        return local;
    }
    /// A local with the same word in all lanes.
    Local constant(std::uint64_t word);
    /// A local with the same number, rounded to the precision, in all lanes.
    Local number(double value) { return constant(word_of(value, precision_)); }

    /// A local with the words 0, 1, 2, ….
    Local lane_numbers();
    /// A local with the words 1, 2, 4, ….
    Local lane_bits();

    /// The function in binary format: its locals, followed by this code.
    Bytes with_locals(const Code& code) const;

private:
    Local declare(LocalType type);
    std::vector<Local>& free_of(LoopLevel level, LocalType type) {
        return free_[level == LoopLevel::link][type == LocalType::vector];
    }

    Precision precision_;
    std::uint32_t parameters_;
    std::array<Code, 4> codes_;  ///< The code of each loop level.
    std::vector<LocalType> types_;
    std::array<std::array<std::vector<Local>, 2>, 2> free_;
    std::map<std::uint64_t, Local> constants_;
    std::optional<Local> lane_numbers_, lane_bits_;
};

}  // namespace cascade::wasm
