// Declares locals, and reuses locals of cells and links.
#include "wasm/function.h"

namespace cascade::wasm {

Local Function::declare(LocalType type) {
    types_.push_back(type);
    return Local(parameters_ + static_cast<std::uint32_t>(types_.size()) - 1);
}

Local Function::take(LoopLevel level, LocalType type) {
    std::vector<Local>& free = free_of(level, type);
    if (level < LoopLevel::cell || free.empty()) return declare(type);
    const Local local = free.back();
    free.pop_back();
    return local;
}

void Function::give_back(Local local, LoopLevel level) {
    if (level < LoopLevel::cell) return;
    free_of(level, types_[static_cast<std::uint32_t>(local) - parameters_]).push_back(local);
}

Local Function::constant(std::uint64_t word) {
    const auto known = constants_.find(word);
    if (known != constants_.end()) return known->second;
    at(LoopLevel::call).vector(word);
    return constants_[word] = keep(LoopLevel::call);
}

Local Function::lane_numbers() {
    if (!lane_numbers_) {
        at(LoopLevel::call).vector(0, 1);
        lane_numbers_ = keep(LoopLevel::call);
    }
    return *lane_numbers_;
}

Local Function::lane_bits() {
    if (!lane_bits_) {
        Code& code = at(LoopLevel::call);
        code.vector(0);
        for (int lane = 0; lane < lanes(); ++lane) {
            code.integer(1 << lane);
            if (precision_ == Precision::binary64) code.write(Plain::extend);
            code.write(Lanes::word_replace, lane);
        }
        lane_bits_ = keep(LoopLevel::call);
    }
    return *lane_bits_;
}

Bytes Function::with_locals(const Code& code) const {
    Bytes runs;
    std::uint32_t run_count = 0;
    for (std::size_t first = 0; first < types_.size();) {
        std::size_t end = first;
        while (end < types_.size() && types_[end] == types_[first]) ++end;
        append_unsigned(runs, end - first);
        runs.push_back(static_cast<std::uint8_t>(types_[first]));
        ++run_count;
        first = end;
    }
    Bytes function;
    append_unsigned(function, run_count);
    append(function, runs);
    append(function, code.bytes());
    return function;
}

}  // namespace cascade::wasm
