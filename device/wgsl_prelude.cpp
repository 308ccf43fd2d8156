// Prints the beginning of a program in WGSL.
#include "device/wgsl_prelude.h"

#include "core/check.h"
#include "device/operation_texts.h"
#include "device/wgsl_arithmetic.h"

#include <fmt/format.h>

namespace cascade {
namespace {

constexpr std::string_view wgsl_bindings = R"(
@group(0) @binding(1) var<storage, read_write> c_planes: array<u32>;
@group(0) @binding(2) var<storage, read> c_mask_words: array<u32>;
@group(0) @binding(3) var<storage, read> c_uniforms: array<u32>;
fn c_mask(c_place: i32) -> bool {
    let c_byte = u32(c_place);
    return ((c_mask_words[c_byte >> 2u] >> (8u * (c_byte & 3u))) & 0xffu) != 0u;
}
)";

// Offsets and marks of filled links have 16 bits.
constexpr std::string_view wgsl_link_functions = R"(
@group(0) @binding(4) var<storage, read> c_links: array<u32>;
var<private> c_slice: u32;
var<private> c_lane: u32;
fn c_half_word(c_table: u32, c_index: u32) -> u32 {
    return c_links[c_table + (c_index >> 1u)] >> (16u * (c_index & 1u));
}
fn c_is_filled(c_entry: u32) -> bool {
    return ((c_half_word(c_call[1].z, c_entry) >> c_lane) & 1u) == 1u;
}
fn c_end_of_link(c_entry: u32) -> i32 {
    let c_offset = c_half_word(c_call[1].y, c_entry * 16u + c_lane);
    return bitcast<i32>(c_links[c_call[1].x + c_entry]) + (bitcast<i32>(c_offset << 16u) >> 16u);
}
)";

/// A function that sums `term` over the links of a cell, each time multiplied by the weight of the
/// link. The weights are in `array`, from index `table` on.
std::string over_links(std::string_view head, std::string_view table, std::string_view term,
                       std::string_view array = "c_links") {
    return fmt::format(
        "fn {0} -> u32 {{\n"
        "    var c_total = 0u;\n"
        "    let c_own = c_field_word(c_planes[c_f + c_at]);\n"
        "    for (var c_entry = c_links[c_slice]; c_entry < c_links[c_slice + 1u]; c_entry++) {{\n"
        "        let c_there = c_end_of_link(c_entry);\n"
        "        let c_apart = c_subtract(c_field_word(c_planes[c_f + c_there]), c_own);\n"
        "        let c_weight = c_field_word({3}[{1} + c_entry * 16u + c_lane]);\n"
        "        c_total = c_add(c_total, c_multiply(c_weight, {2}));\n"
        "    }}\n"
        "    return c_total;\n"
        "}}\n",
        head, table, term, array);
}

/// The functions of operations on operands.
std::string wgsl_operations() {
    std::string text;
    for (int number = 0; number < op_count; ++number) {
        const Op op = static_cast<Op>(number);
        if (info(op).arity == 0) continue;
        constexpr std::string_view parameters[] = {"a: u32", "a: u32, b: u32",
                                                   "a: u32, b: u32, c: u32"};
        const int operands = is_link_reduction(op) ? 2 : info(op).arity;
        text += fmt::format("fn c_{}({}) -> u32 {{ return {}; }}\n", info(op).name,
                            parameters[operands - 1], text_of(op, TextLanguage::wgsl));
    }
    return text;
}

}  // namespace

std::string wgsl_prelude(const TextTarget& target, std::size_t call_words) {
    CHECK(target.precision == Precision::single, "WGSL has no double precision");
    std::string text =
        fmt::format("@group(0) @binding(0) var<uniform> c_call: array<vec4<u32>, {}>;",
                    (call_words + 3) / 4);
    text += wgsl_bindings;
    text += wgsl::arithmetic;
    text +=
        target.flushing == Flushing::by_device ? wgsl::flushed_by_device : wgsl::flushed_by_kernel;
    text += wgsl_operations();
    text += wgsl::compositions;
    return text;
}

std::string wgsl_stencil(Stencil stencil, const PlaneLayout& layout) {
    if (stencil.links) {
        const std::string_view weights = "c_call[1].w";
        return std::string(wgsl_link_functions) +
               over_links("c_laplacian(c_f: i32, c_at: i32)", weights, "c_apart") +
               over_links("c_link_squares(c_f: i32, c_at: i32)", weights,
                          "c_multiply(c_apart, c_apart)") +
               over_links("c_link_flow(c_f: i32, c_s: i32, c_at: i32)", weights,
                          "c_multiply(c_add(c_field_word(c_planes[c_s + c_there]), "
                          "c_field_word(c_planes[c_s + c_at])), c_apart)") +
               over_links("c_link_weighted(c_f: i32, c_s: i32, c_at: i32)", "u32(c_s)", "c_apart",
                          "c_planes") +
               over_links("c_gradient(c_f: i32, c_at: i32, c_components: u32)", "c_components",
                          "c_apart");
    }
    const std::string sum = neighbour_sum(stencil, layout, "c_planes[c_f + c_at + ({})]");
    const std::string own = "c_field_word(c_planes[c_f + c_at])";
    const std::string of_six = fmt::format("c_subtract({}, c_multiply(0x40c00000u, {}))", sum, own);
    const std::string of_fewer =
        fmt::format("c_minus_multiple({}, {}.0, {})", sum, 2 * stencil.axes(), own);
    return fmt::format("fn c_laplacian(c_f: i32, c_at: i32) -> u32 {{\n    return {};\n}}\n",
                       stencil.axes() == 3 ? of_six : of_fewer);
}

std::string wgsl_head(std::string_view name) {
    return fmt::format(
        "@compute @workgroup_size({}, {})\nfn {}(@builtin(global_invocation_id) c_id: vec3<u32>) ",
        wgsl_group_width, wgsl_group_height, name);
}

std::string wgsl_call_word(std::size_t word) {
    return fmt::format("c_call[{}].{}", word / 4, "xyzw"[word % 4]);
}

}  // namespace cascade
