// Gives each kernel separate planes in the buffers, and prints the kernel c_halo.
#include "device/wgsl_kernels.h"

#include "device/kernel_text.h"
#include "device/wgsl_prelude.h"

#include <fmt/format.h>

namespace cascade {
namespace {

// A halo cell at an edge follows the rules of its sides one after the other: columns, rows, slices.
constexpr std::string_view wgsl_halo_kernel = R"(
@group(0) @binding(5) var<storage, read> c_sides: array<u32>;
fn c_beyond(c_kind: u32, c_cell: u32, c_value: u32, c_spacing: u32) -> u32 {
    if (c_kind == 2u) {
        return c_subtract(c_multiply(0x40000000u, c_value), c_flush(c_cell));
    }
    return c_add(c_flush(c_cell), c_multiply(c_spacing, c_value));
}
// The cell beside a side: the first or the last of an axis.
fn c_source(c_kind: u32, c_is_first: bool, c_count: i32) -> i32 {
    return select(0, c_count - 1, c_is_first == (c_kind == 0u));
}
struct C_Sides { kinds: u32, numbers: u32, values: u32 }
fn c_apply(c_cell: u32, c_side: u32, c_number_of_cell: i32, c_of: C_Sides) -> u32 {
    let c_kind = c_sides[c_of.kinds + c_side];
    if (c_kind < 2u) { return c_cell; }
    let c_first = bitcast<i32>(c_sides[c_of.kinds + 6u + c_side]);
    var c_value = c_sides[c_of.numbers + c_side];
    if (c_first >= 0) { c_value = c_sides[c_of.values + u32(c_first + c_number_of_cell)]; }
    return c_beyond(c_kind, c_cell, c_flush(c_value), c_flush(c_sides[c_of.numbers + 6u]));
}
@compute @workgroup_size(64)
fn c_halo(@builtin(global_invocation_id) c_id: vec3<u32>) {
    let c_record = c_call[3].x;
    let c_planes_in_all = c_call[3].y;
    let c_is_slice = c_call[3].z == 1u;
    let c_slices = select(u32(c_depth), 2u, c_is_slice);
    let c_plane = c_id.y / c_slices;
    let c_which = i32(c_id.y % c_slices);
    // Halo slices are -1 and depth.
    let k = select(c_which, select(c_depth, -1, c_which == 0), c_is_slice);
    let n = i32(c_id.x);
    let c_beside = n - 2 * (c_width + 2);
    var i = n % (c_width + 2) - 1;
    var j = select(c_height, -1, n < c_width + 2);
    if (c_is_slice) {
        j = n / (c_width + 2) - 1;
        if (j > c_height) { return; }
    } else if (c_beside >= 0) {
        i = select(c_width, -1, c_beside % 2 == 0);
        j = c_beside / 2;
        if (j >= c_height) { return; }
    }
    let c_first = c_record + c_planes_in_all;
    let c_of = C_Sides(c_first + 12u * c_plane, c_first + 12u * c_planes_in_all + 7u * c_plane,
                       c_first + 19u * c_planes_in_all);
    let x = select(1u, 0u, i < 0);
    let y = select(3u, 2u, j < 0);
    let z = select(5u, 4u, k < 0);
    var c_column = i;
    var c_line = j;
    var c_slice_of_cell = k;
    let c_beyond_x = i < 0 || i >= c_width;
    let c_beyond_y = j < 0 || j >= c_height;
    let c_beyond_z = k < 0 || k >= c_depth;
    if (c_beyond_x) { c_column = c_source(c_sides[c_of.kinds + x], i < 0, c_width); }
    if (c_beyond_y) { c_line = c_source(c_sides[c_of.kinds + y], j < 0, c_height); }
    if (c_beyond_z) { c_slice_of_cell = c_source(c_sides[c_of.kinds + z], k < 0, c_depth); }
    let c_origin = bitcast<i32>(c_sides[c_record + c_plane]);
    var c_cell = c_planes[c_origin + c_slice_of_cell * c_slice_stride + c_line * c_stride + c_column];
    if (c_beyond_x) { c_cell = c_apply(c_cell, x, c_slice_of_cell * c_height + c_line, c_of); }
    if (c_beyond_y) { c_cell = c_apply(c_cell, y, c_slice_of_cell * c_width + c_column, c_of); }
    if (c_beyond_z) { c_cell = c_apply(c_cell, z, c_line * c_width + c_column, c_of); }
    c_planes[c_origin + k * c_slice_stride + j * c_stride + i] = c_cell;
}
)";

TextTarget wgsl_target(Flushing flushing) {
    TextTarget target;
    target.flushing = flushing;
    target.language = TextLanguage::wgsl;
    return target;
}

}  // namespace

WgslKernels wgsl_kernels(std::span<const CellKernel* const> kernels, const Grid& grid,
                         Flushing flushing) {
    const TextTarget target = wgsl_target(flushing);
    const PlaneLayout layout(grid);
    WgslKernels made;
    made.text = wgsl_prelude(target, first_call_word) + wgsl_stencil(grid.stencil(), layout);
    const auto place = [&](std::size_t plane) {
        return fmt::format("{}",
                           static_cast<std::int64_t>(plane) * layout.size() + layout.offset(0, 0));
    };
    for (const CellKernel* const kernel : kernels) {
        WgslKernels::Place& next = made.end;
        made.places.push_back(next);
        KernelNames names;
        for (std::size_t k = 0; k < kernel->field_names.size(); ++k) {
            names.fields.push_back(place(next.plane++));
        }
        for (std::size_t k = 0; k < kernel->results.size(); ++k) {
            names.results.push_back(place(next.plane++));
        }
        for (std::size_t k = 0; k < kernel->mask_names.size(); ++k) {
            names.masks.push_back(place(next.mask++));
        }
        for (std::size_t k = 0; k < kernel->uniform_names.size(); ++k) {
            names.uniforms.push_back(fmt::format("c_uniforms[{}]", next.uniform++));
        }
        made.text += wgsl_head(fmt::format("c_kernel_{}", made.places.size() - 1)) + "{\n";
        made.text += cells_begin(target, grid.stencil(), layout, 1);
        made.text += cell_text(*kernel, names, target, grid.stencil(), layout);
        made.text += std::string(cells_end) + "}\n";
    }
    return made;
}

std::string wgsl_halo(Flushing flushing, const PlaneLayout& layout) {
    std::string text = wgsl_prelude(wgsl_target(flushing), wgsl_halo_words);
    text += fmt::format("const c_width = {};\nconst c_height = {};\nconst c_depth = {};\n",
                        layout.width, layout.height, layout.depth);
    text += fmt::format("const c_stride = {};\nconst c_slice_stride = {};\n", layout.stride,
                        layout.slice_stride);
    text += wgsl_halo_kernel;
    return text;
}

}  // namespace cascade
