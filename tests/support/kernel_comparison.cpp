// Inputs, runs and comparisons of kernels.
#include "tests/support/kernel_comparison.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "tests/support/random_stream.h"

#include <fmt/format.h>

namespace cascade::testing {
namespace {

/// What results hold before a kernel writes them: a NaN with bits that no arithmetic makes.
constexpr std::uint32_t untouched = 0x7fabcdef;

void fill_with(Field& field, std::uint32_t word) {
    float* all = field.origin() - field.layout().offset(0, 0);
    for (std::int64_t k = 0; k < field.layout().size(); ++k) all[k] = to_number(word);
}

bool is_nan(std::uint32_t word) { return (word & 0x7fffffff) > 0x7f800000; }

Field hostile_field(RandomStream& stream, const Grid& grid) {
    Field field{PlaneLayout(grid)};
    fill_with(field, untouched);
    // A field of trouble alone would make every laplacian NaN.
    const int trouble_percent = stream.chance(50) ? 5 : 40;
    for (std::int64_t row = 0; row < field.layout().row_count(); ++row) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const bool is_trouble = stream.chance(trouble_percent);
            field.row(row)[i] =
                is_trouble ? to_number(hostile_word(stream)) : stream.symmetric() * 8.0f;
        }
    }
    fill_halo(field.origin(), field.layout(), grid.boundary);
    return field;
}

Mask random_mask(RandomStream& stream, const Grid& grid) {
    Mask mask{PlaneLayout(grid)};
    for (std::int64_t row = 0; row < mask.layout().row_count(); ++row) {
        for (std::int64_t i = 0; i < grid.width; ++i) mask.row(row)[i] = stream.chance(40) ? 1 : 0;
    }
    return mask;
}

}  // namespace

HostileInputs::HostileInputs(const CellKernel& kernel, const Grid& grid, std::uint64_t seed)
    : grid_(grid), result_count_(kernel.results.size()) {
    RandomStream stream(seed);
    for (std::size_t k = 0; k < kernel.field_names.size(); ++k) {
        fields_.push_back(hostile_field(stream, grid));
    }
    for (std::size_t k = 0; k < kernel.mask_names.size(); ++k) {
        masks_.push_back(random_mask(stream, grid));
    }
    for (std::size_t k = 0; k < kernel.uniform_names.size(); ++k) {
        uniforms_.push_back(stream.chance(30) ? to_number(hostile_word(stream))
                                              : stream.symmetric() * 4.0f);
    }
}

std::vector<Field> HostileInputs::run(const Kernel& kernel) const {
    return run(kernel, {0, PlaneLayout(grid_).row_count()});
}

std::vector<Field> HostileInputs::run(const Kernel& kernel, RowRange rows) const {
    std::vector<const float*> fields;
    for (const Field& field : fields_) fields.push_back(field.origin());
    std::vector<const std::uint8_t*> masks;
    for (const Mask& mask : masks_) masks.push_back(mask.origin());
    std::vector<Field> results;
    std::vector<float*> targets;
    for (std::size_t k = 0; k < result_count_; ++k) {
        results.emplace_back(PlaneLayout(grid_));
        fill_with(results.back(), untouched);
        targets.push_back(results.back().origin());
    }
    const FlushDenormals environment;
    kernel.run({fields, masks, uniforms_, targets, PlaneLayout(grid_)}, rows);
    return results;
}

std::vector<Field> run_kernel(Backend& backend, const CellKernel& kernel, const Grid& grid,
                              std::uint64_t seed) {
    const Result<KernelPointer> compiled = backend.compile(kernel, grid.stencil());
    CHECK(compiled, "test: the backend compiles every kernel");
    return HostileInputs(kernel, grid, seed).run(**compiled);
}

std::string same_bits(const std::vector<Field>& a, const std::vector<Field>& b) {
    if (a.size() != b.size()) return fmt::format("{} and {} results", a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        const PlaneLayout& layout = a[k].layout();
        if (!(layout == b[k].layout())) return fmt::format("result {}: other layout", k);
        for (std::int64_t j = 0; j < layout.row_count(); ++j) {
            for (std::int64_t i = 0; i < layout.width; ++i) {
                const std::uint32_t x = to_bits(a[k].row(j)[i]);
                const std::uint32_t y = to_bits(b[k].row(j)[i]);
                if (x == y || (is_nan(x) && is_nan(y))) continue;
                return fmt::format("result {}, column {}, row {}: 0x{:08x} ({}) and 0x{:08x} ({})",
                                   k, i, j, x, to_number(x), y, to_number(y));
            }
        }
    }
    return "";
}

std::string stray_writes(const std::vector<Field>& results, RowRange rows) {
    for (std::size_t k = 0; k < results.size(); ++k) {
        const PlaneLayout& layout = results[k].layout();
        const std::int64_t pad = PlaneLayout::row_pad;
        const std::int64_t end = (layout.width + pad - 1) / pad * pad;
        const std::int64_t halo = layout.has_halo_slices() ? 1 : 0;
        for (std::int64_t row = -layout.slice_rows() * halo - 1;
             row <= layout.slice_rows() * (layout.depth - 1 + halo) + layout.height; ++row) {
            // Rows of memory, those of the halo among them.
            const std::int64_t slice = (row + 1 + layout.slice_rows()) / layout.slice_rows() - 1;
            const std::int64_t j = row - slice * layout.slice_rows();
            const std::int64_t number = slice * layout.height + j;
            const bool is_computed =
                0 <= j && j < layout.height && rows.begin <= number && number < rows.end;
            for (std::int64_t i = -pad; i < layout.stride - pad; ++i) {
                if (is_computed && 0 <= i && i < end) continue;
                if (to_bits(results[k].at(i, j, slice)) == untouched) continue;
                return fmt::format("result {}: column {}, row {}, slice {} was written", k, i, j,
                                   slice);
            }
        }
    }
    return "";
}

Grid random_grid(std::uint64_t seed, std::int64_t max_width, std::int64_t max_height,
                 std::int64_t max_depth) {
    RandomStream stream(seed);
    Grid grid;
    grid.width = 1 + stream.below(static_cast<std::uint64_t>(max_width));
    grid.height = 1 + stream.below(static_cast<std::uint64_t>(max_height));
    const auto boundary = [&] {
        return stream.chance(50) ? Boundary::periodic : Boundary::no_flux;
    };
    grid.boundary = {boundary(), boundary(), boundary()};
    if (max_depth > 1 && stream.chance(60)) {
        grid.depth = 1 + stream.below(static_cast<std::uint64_t>(max_depth));
    }
    return grid;
}

}  // namespace cascade::testing
