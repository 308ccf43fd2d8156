// Prints one declaration for each value. Values that belong to links are declared in the loops over
// links.
#include "device/kernel_text.h"

#include "core/check.h"
#include "device/operation_texts.h"
#include "ir/loop_levels.h"
#include "ir/word_operations.h"

#include <fmt/format.h>

#include <string_view>

namespace cascade {
namespace {

std::string replaced(std::string_view text, char mark, std::string_view by) {
    std::string result;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '$' && k + 1 < text.size() && text[k + 1] == mark) {
            result += by;
            ++k;
        } else {
            result += text[k];
        }
    }
    return result;
}

/// Whether the operation reads its operands as numbers, so that it must not see denormal numbers.
bool reads_numbers(Op op) {
    switch (op) {
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::divide:
        case Op::square_root:
        case Op::round_to_even:
        case Op::scale_by_power:
        case Op::multiply_add:
        case Op::less:
        case Op::less_equal:
        case Op::equal:
        case Op::not_equal: return true;
        default: return false;
    }
}

/// Whether the operation copies words, so that its result may be denormal although arithmetic
/// flushes.
bool passes_words(Op op) {
    switch (op) {
        case Op::field:
        case Op::neighbour:
        case Op::theirs:
        case Op::uniform:
        case Op::cell_column:
        case Op::cell_row:
        case Op::cell_slice:
        case Op::negate:
        case Op::absolute:
        case Op::select:
        case Op::bits_add:
        case Op::bits_subtract:
        case Op::bits_multiply:
        case Op::bits_and:
        case Op::bits_or:
        case Op::bits_xor:
        case Op::bits_shift_left:
        case Op::bits_shift_right: return true;
        default: return false;
    }
}

/// The beginning of a loop over the links of a cell.
constexpr std::string_view opencl_loop = R"(
        for (uint c_entry = c_starts[c_slice]; c_entry < c_starts[c_slice + 1]; ++c_entry) {
        if ((c_filled[c_entry] >> c_lane & 1) == 0) continue;
        const c_long c_there = c_bases[c_entry] + c_offsets[(c_long)c_entry * 16 + c_lane];
)";
constexpr std::string_view wgsl_loop = R"(
        for (var c_entry = c_links[c_slice]; c_entry < c_links[c_slice + 1u]; c_entry++) {
        if (!c_is_filled(c_entry)) { continue; }
        let c_there = c_end_of_link(c_entry);
)";

class CellPrinter {
public:
    CellPrinter(const CellKernel& kernel, const KernelNames& names, const TextTarget& target,
                Stencil stencil, const PlaneLayout& layout)
        : kernel_(kernel),
          names_(names),
          target_(target),
          stencil_(stencil),
          layout_(layout),
          levels_(loop_levels_of(kernel)) {}

    std::string print() {
        const CellSchedule schedule = cell_schedule_of(kernel_, levels_);
        for (const ValueId id : kernel_.code.ids()) {
            if (levels_[id] < LoopLevel::cell) declare(id);
        }
        for (const LinkLoop& loop : schedule.loops) print(loop);
        for (const ValueId id : schedule.after) declare(id);
        for (std::size_t k = 0; k < kernel_.results.size(); ++k) {
            const std::string& plane = names_.results[k];
            const std::string target = is_wgsl() ? fmt::format("c_planes[{} + c_at]", plane)
                                                 : fmt::format("({})[c_at]", plane);
            text_ += fmt::format("        {} = {};\n", target, value(kernel_.results[k]));
        }
        return std::move(text_);
    }

private:
    static std::string value(ValueId id) { return fmt::format("c_v{}", id.index()); }

    const WordFormat& format() const {
        static const WordFormat formats[] = {format_of(Precision::single),
                                             format_of(Precision::binary64)};
        return formats[kernel_.precision == Precision::single ? 0 : 1];
    }

    bool is_wgsl() const { return target_.language == TextLanguage::wgsl; }
    bool flushes_here() const { return target_.flushing == Flushing::by_kernel; }

    bool may_be_denormal(ValueId id) const {
        const Instruction& instruction = kernel_.code[id];
        if (instruction.op == Op::constant) return format().is_denormal(instruction.payload);
        return passes_words(instruction.op);
    }

    /// The text of a constant, combined with c_pad if compilers could otherwise simplify arithmetic
    /// with the constant.
    std::string word(std::uint64_t bits) const {
        const std::string literal =
            fmt::format("{:#x}{}", bits, target_.precision == Precision::single ? "u" : "ul");
        const std::uint64_t size = bits & ~format().sign();
        const bool simplifies = size == 0 || size == format().one() || format().is_denormal(size);
        const bool is_hidden = simplifies && (is_wgsl() || !flushes_here());
        return is_hidden ? fmt::format("({} ^ c_pad)", literal) : literal;
    }

    std::string operand(const Instruction& instruction, int number) const {
        const ValueId id = instruction.operands[static_cast<std::size_t>(number)];
        if (!may_be_denormal(id)) return value(id);
        if (flushes_here()) {
            return reads_numbers(instruction.op) ? fmt::format("c_flush({})", value(id))
                                                 : value(id);
        }
        const bool is_chosen = instruction.op == Op::select && number > 0;
        return is_chosen ? fmt::format("({} ^ c_pad)", value(id)) : value(id);
    }

    std::string distance(const Neighbour& at) const {
        std::int64_t elements = 0;
        if (stencil_.x) elements += at.dx;
        if (stencil_.y) elements += at.dy * layout_.stride;
        if (stencil_.z) elements += at.dz * layout_.slice_stride;
        return fmt::format("{}", elements);
    }

    std::string source(const Instruction& instruction) const {
        const std::string_view text = text_of(instruction.op, target_.language);
        const std::uint64_t payload = instruction.payload;
        switch (info(instruction.op).payload) {
            case PayloadKind::none: return std::string(text);
            case PayloadKind::bits: return replaced(text, 'w', word(payload));
            case PayloadKind::uniform: return replaced(text, 'w', names_.uniforms[payload]);
            case PayloadKind::mask:
                return replaced(text, 'm', fmt::format("({})", names_.masks[payload]));
            case PayloadKind::field: return with_field(text, instruction.field());
            case PayloadKind::neighbour: {
                const Neighbour at = Neighbour::of(instruction.slot());
                return with_field(replaced(text, 'd', distance(at)), at.slot);
            }
            case PayloadKind::flow: {
                const Flow flow = Flow::with(payload);
                const std::string factor = fmt::format("({})", names_.fields[flow.factor.index()]);
                return with_field(replaced(text, 's', factor), flow.of);
            }
        }
        return {};
    }

    std::string with_field(std::string_view text, FieldSlot slot) const {
        return replaced(text, 'f', fmt::format("({})", names_.fields[slot.index()]));
    }

    std::string expression(const Instruction& instruction) const {
        const int arity = info(instruction.op).arity;
        if (arity == 0) return source(instruction);
        std::string operands;
        for (int k = 0; k < arity; ++k) {
            operands += (k > 0 ? ", " : "") + operand(instruction, k);
        }
        return fmt::format("c_{}({})", info(instruction.op).name, operands);
    }

    void declare(ValueId id) {
        text_ += fmt::format("        {} {} = {};\n", is_wgsl() ? "let" : "const cw", value(id),
                             expression(kernel_.code[id]));
    }

    /// Prints one loop over the links of the cell.
    void print(const LinkLoop& loop) {
        for (const ValueId id : loop.before) declare(id);
        for (const ValueId id : loop.reductions) {
            const Op op = kernel_.code[id].op;
            const std::string_view first = op == Op::link_sum     ? "0u"
                                           : op == Op::link_least ? "C_INFINITY"
                                                                  : "C_INFINITY | C_SIGN";
            text_ +=
                fmt::format("        {} {} = {};\n", is_wgsl() ? "var" : "cw", value(id), first);
        }
        text_ += is_wgsl() ? wgsl_loop : opencl_loop;
        for (const ValueId id : loop.values) declare(id);
        for (const ValueId id : loop.reductions) {
            const Instruction& instruction = kernel_.code[id];
            text_ += fmt::format("        {0} = c_{1}(c_flush({2}), {0});\n", value(id),
                                 info(instruction.op).name, value(instruction.operands[0]));
        }
        text_ += "        }\n";
        for (const ValueId id : loop.reductions) {
            if (kernel_.code[id].op != Op::link_sum) continue;
            const std::string sum = value(id);
            text_ += is_wgsl() ? fmt::format("        {0} = select({0}, 0u, {0} == C_SIGN);\n", sum)
                               : fmt::format("        {0} = {0} == C_SIGN ? 0 : {0};\n", sum);
        }
    }

    const CellKernel& kernel_;
    const KernelNames& names_;
    const TextTarget& target_;
    Stencil stencil_;
    const PlaneLayout& layout_;
    IdVector<ValueId, LoopLevel> levels_;
    std::string text_;
};

}  // namespace

std::string cell_text(const CellKernel& kernel, const KernelNames& names, const TextTarget& target,
                      Stencil stencil, const PlaneLayout& layout) {
    CHECK(kernel.precision == target.precision, "a program has one precision");
    return CellPrinter(kernel, names, target, stencil, layout).print();
}

std::string cells_begin(const TextTarget& target, Stencil stencil, const PlaneLayout& layout,
                        std::int64_t rows_of_item) {
    const std::int64_t slices = (layout.width + PlaneLayout::row_pad - 1) / PlaneLayout::row_pad;
    if (target.language == TextLanguage::wgsl) {
        CHECK(rows_of_item == 1, "a work-item in WGSL computes one cell");
        std::string text = fmt::format(
            "    let c_pad = c_call[0].x;\n"
            "    let c_i = i32(c_id.x);\n"
            "    let c_row = bitcast<i32>(c_call[0].y) + i32(c_id.y);\n"
            "    if (c_i >= {0} || c_row >= bitcast<i32>(c_call[0].z)) {{ return; }}\n"
            "    {{\n"
            "        let c_j = c_row % {1};\n"
            "        let c_k = c_row / {1};\n"
            "        let c_at = c_k * {2} + c_j * {3} + c_i;\n",
            layout.width, layout.height, layout.slice_stride, layout.stride);
        if (stencil.links) {
            text += fmt::format("        c_slice = u32(c_row * {} + c_i / {});\n", slices,
                                PlaneLayout::row_pad);
            text += fmt::format("        c_lane = u32(c_i % {});\n", PlaneLayout::row_pad);
        }
        return text;
    }
    std::string text = fmt::format(
        "    const int c_i = get_global_id(0);\n"
        "    const int c_begin = c_first_row + (int)get_global_id(1) * {0};\n"
        "    const int c_end = min(c_begin + {0}, c_last_row);\n"
        "    for (int c_row = c_begin; c_row < c_end; ++c_row) {{\n"
        "        const int c_j = c_row % {1}, c_k = c_row / {1};\n"
        "        const c_long c_at = (c_long)c_k * {2} + (c_long)c_j * {3} + c_i;\n",
        rows_of_item, layout.height, layout.slice_stride, layout.stride);
    if (stencil.links) {
        text += fmt::format("        const uint c_slice = c_row * {} + c_i / {};\n", slices,
                            PlaneLayout::row_pad);
        text += fmt::format("        const uint c_lane = c_i % {};\n", PlaneLayout::row_pad);
    }
    return text;
}

}  // namespace cascade
