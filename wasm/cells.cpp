// Loads the cells' own values and their neighbours' values, masks and positions, and stores
// results.
#include "wasm/cells.h"

#include "core/check.h"

namespace cascade::wasm {
namespace {

constexpr const char* only_linked = "only linked cells have links";

}  // namespace

void Cells::begin_links() { CHECK(false, only_linked); }
void Cells::end_links() { CHECK(false, only_linked); }
Local Cells::theirs(FieldSlot) { CHECK(false, only_linked); }
Local Cells::is_link() { CHECK(false, only_linked); }

void Cells::end_vector() {
    for (const Local local : kept_) function_.give_back(local);
    kept_.clear();
    loads_.clear();
    operands_.clear();
}

Local Cells::keep() {
    kept_.push_back(function_.keep(LoopLevel::cell));
    return kept_.back();
}

Local Cells::plane(Parameter table, std::size_t slot) {
    const auto [known, is_new] = planes_.try_emplace({table, slot});
    if (is_new) {
        Code& code = function_.at(LoopLevel::call);
        code.get(local_of(table));
        code.access(Plain::load, static_cast<std::uint32_t>(4 * slot));
        if (table != Parameter::masks) {
            code.integer(static_cast<std::int32_t>(pad_bytes()));
            code.write(Plain::subtract);
        }
        known->second = function_.keep(LoopLevel::call, LocalType::integer);
    }
    return known->second;
}

/// The distance in bytes to the row that is dy rows and dz slices away. Computed once per call.
Local Cells::row_offset(int dy, int dz) {
    const auto [known, is_new] = row_offsets_.try_emplace({dy, dz});
    if (is_new) {
        Code& code = function_.at(LoopLevel::call);
        code.integer(dy);
        if (dz != 0) {
            code.get(local_of(Parameter::slice_rows));
            code.integer(dz);
            code.write(Plain::multiply);
            code.write(Plain::add);
        }
        code.get(local_of(Parameter::stride));
        code.write(Plain::multiply);
        code.integer(function_.number_shift());
        code.write(Plain::shift_left);
        known->second = function_.keep(LoopLevel::call, LocalType::integer);
    }
    return known->second;
}

/// The address of the group's first cell in a row of a plane, minus pad_bytes().
Local Cells::address(const RowOfPlane& row) {
    const auto [known, is_new] = addresses_.try_emplace(row);
    if (is_new) {
        code().get(plane(row.table, row.slot));
        code().get(place_.group);
        if (row.table == Parameter::masks) {
            code().integer(function_.number_shift());
            code().write(Plain::shift_right);
        }
        code().write(Plain::add);
        if (row.dy != 0 || row.dz != 0) {
            code().get(row_offset(row.dy, row.dz));
            code().write(Plain::add);
        }
        known->second = function_.keep(LoopLevel::cell, LocalType::integer);
    }
    return known->second;
}

Local Cells::load(const Reading& reading) {
    const auto [known, is_new] = loads_.try_emplace(reading);
    if (is_new) {
        code().get(address({Parameter::fields, reading.slot.index(), reading.dy, reading.dz}));
        const int columns = reading.dx * function_.number_bytes();
        code().access(Whole::load,
                      pad_bytes() + offset_of_vector() + static_cast<unsigned>(columns));
        known->second = keep();
    }
    return known->second;
}

Local Cells::operand(const Reading& reading) {
    if (!is_exact_) return load(reading);
    const auto [known, is_new] = operands_.try_emplace(reading);
    if (is_new) {
        code().get(load(reading));
        arithmetic().flush();
        known->second = keep();
    }
    return known->second;
}

Local Cells::neighbour(Neighbour at) {
    return load({at.slot, stencil_.x ? at.dx : 0, stencil_.y ? at.dy : 0, stencil_.z ? at.dz : 0});
}

// Turns the cells' bytes into words.
Local Cells::mask(MaskSlot slot) {
    code().get(address({Parameter::masks, slot.index()}));
    const auto offset = static_cast<std::uint32_t>(vector_ * function_.lanes());
    if (function_.precision() == Precision::single) {
        code().access(Whole::load_32_zero, offset);
    } else {
        code().access(Whole::load_16_splat, offset);
    }
    code().write(Whole::widen_8);
    code().write(Whole::widen_16);
    if (function_.precision() == Precision::binary64) code().write(Whole::widen_32);
    code().get(function_.constant(0));
    code().write(Lanes::word_not_equal);
    return keep();
}

Local Cells::uniform(UniformSlot slot) {
    Code& code = function_.at(LoopLevel::call);
    code.get(local_of(Parameter::uniforms));
    const int bytes = function_.number_bytes();
    code.access(Lanes::load_splat, slot.index() * static_cast<std::uint32_t>(bytes));
    return function_.keep(LoopLevel::call);
}

void Cells::splat_word(Code& code) {
    if (function_.precision() == Precision::binary64) code.write(Plain::extend);
    code.write(Lanes::word_splat);
}

Local Cells::cell_row() {
    Code& code = function_.at(LoopLevel::row);
    code.get(local_of(Parameter::row_begin));
    if (stencil_.z) {
        code.get(local_of(Parameter::slice));
        code.get(local_of(Parameter::slice_rows));
        code.write(Plain::multiply);
        code.write(Plain::subtract);
    }
    splat_word(code);
    return function_.keep(LoopLevel::row);
}

Local Cells::cell_slice() {
    Code& code = function_.at(LoopLevel::row);
    if (stencil_.z) {
        code.get(local_of(Parameter::slice));
    } else {
        code.integer(0);
    }
    splat_word(code);
    return function_.keep(LoopLevel::row);
}

void Cells::push_column() {
    code().get(place_.group);
    code().get(place_.row);
    code().write(Plain::subtract);
    code().integer(function_.number_shift());
    code().write(Plain::shift_right);
    code().integer(vector_ * function_.lanes());
    code().write(Plain::add);
}

Local Cells::cell_column() {
    push_column();
    splat_word(code());
    code().get(function_.lane_numbers());
    code().write(Lanes::word_add);
    return keep();
}

void Cells::store(std::size_t result, Local number) {
    code().get(address({Parameter::results, result}));
    code().get(number);
    code().access(Whole::store, pad_bytes() + offset_of_vector());
}

void Cells::fill_columns(Code& code, std::size_t result, Local row_end) {
    const bool is_single = function_.precision() == Precision::single;
    const auto number_bytes = static_cast<std::uint32_t>(function_.number_bytes());
    const auto copy = [&](Parameter from, Local to, std::uint32_t offset) {
        for (const Local place : {to, place_.row}) {
            code.get(plane(Parameter::results, result));
            code.get(place);
            code.write(Plain::add);
        }
        code.get(local_of(from));
        code.integer(function_.number_shift());
        code.write(Plain::shift_left);
        code.write(Plain::add);
        code.access(is_single ? Plain::load : Plain::long_load, pad_bytes());
        code.access(is_single ? Plain::store : Plain::long_store, offset);
    };
    copy(Parameter::left_column, place_.row, pad_bytes() - number_bytes);
    copy(Parameter::right_column, row_end, pad_bytes());
}

}  // namespace cascade::wasm
