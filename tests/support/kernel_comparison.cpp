// Inputs, runs and comparisons of kernels.
#include "tests/support/kernel_comparison.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "tests/support/random_links.h"
#include "tests/support/random_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>
#include <utility>

namespace cascade::test {
namespace {

/// The content of results before a kernel writes them: a NaN with bits that no arithmetic gives.
template <typename Number>
constexpr WordOf<Number> untouched = 0x7fabcdef;
template <>
constexpr std::uint64_t untouched<double> = 0x7ffabcdef0123456;

template <typename Number>
Plane<Number> untouched_plane(const PlaneLayout& layout) {
    Plane<Number> plane(layout);
    Number* all = plane.origin() - layout.offset(0, 0);
    std::fill_n(all, layout.size(), std::bit_cast<Number>(untouched<Number>));
    return plane;
}

template <typename Number>
Number hostile_number(RandomStream& stream) {
    if constexpr (std::is_same_v<Number, double>) {
        return std::bit_cast<double>(hostile_long_word(stream));
    } else {
        return to_number(hostile_word(stream));
    }
}

/// A number in [−1, 1) with all digits.
template <typename Number>
Number ordinary_number(RandomStream& stream) {
    const float rough = stream.symmetric();
    if constexpr (std::is_same_v<Number, float>) return rough;
    return rough + static_cast<Number>(stream.symmetric()) * Number{0x1p-23};
}

template <typename Number>
Field hostile_field(RandomStream& stream, const Grid& grid) {
    Plane<Number> field = untouched_plane<Number>(PlaneLayout(grid));
    // A field of hostile numbers alone would make every Laplacian NaN.
    const int trouble_percent = stream.chance(50) ? 5 : 40;
    for (std::int64_t row = 0; row < field.layout().row_count(); ++row) {
        for (std::int64_t i = 0; i < grid.width; ++i) {
            const bool is_trouble = stream.chance(trouble_percent);
            field.row(row)[i] =
                is_trouble ? hostile_number<Number>(stream) : ordinary_number<Number>(stream) * 8;
        }
    }
    if (!grid.linked) fill_halo(field.origin(), field.layout(), grid.boundary);
    return Field(std::move(field));
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
    : grid_(grid),
      precision_(kernel.precision),
      is_near_(seed % 2 == 0),
      result_count_(kernel.results.size()) {
    RandomStream stream(seed);
    with_number(precision_, [&](auto zero) { fill<decltype(zero)>(kernel, stream); });
    if (!grid.linked) return;
    const auto in_last_row =
        static_cast<std::int64_t>(stream.below(static_cast<std::uint64_t>(grid.width)));
    const auto cells = static_cast<std::size_t>(grid.cell_count() - in_last_row);
    const LinkList list = random_links(cells, seed, 2);
    links_ = Links(list, PlaneLayout(grid), precision_);
    for (const Instruction& instruction : kernel.code) {
        if (instruction.op != Op::link_weighted) continue;
        std::vector<double> weights(list.neighbours.size());
        with_number(precision_, [&](auto zero) {
            using Number = decltype(zero);
            for (double& weight : weights) {
                weight = stream.chance(5) ? hostile_number<Number>(stream)
                                          : ordinary_number<Number>(stream);
            }
        });
        fields_[Flow::with(instruction.payload).factor.index()] =
            links_.numbers_of(weights, list.ends, PlaneLayout(grid));
    }
}

template <typename Number>
void HostileInputs::fill(const CellKernel& kernel, RandomStream& stream) {
    for (std::size_t k = 0; k < kernel.field_names.size(); ++k) {
        fields_.push_back(hostile_field<Number>(stream, grid_));
    }
    for (std::size_t k = 0; k < kernel.mask_names.size(); ++k) {
        masks_.push_back(random_mask(stream, grid_));
    }
    for (std::size_t k = 0; k < kernel.uniform_names.size(); ++k) {
        const Number number = stream.chance(30) ? hostile_number<Number>(stream)
                                                : ordinary_number<Number>(stream) * 4;
        uniforms_.push_back(std::bit_cast<WordOf<Number>>(number));
    }
}

std::vector<Field> HostileInputs::run(const Kernel& kernel) const {
    return run(kernel, {0, PlaneLayout(grid_).row_count()});
}

std::vector<Field> HostileInputs::run(const Kernel& kernel, const Patch& cells) const {
    return with_number(precision_,
                       [&](auto zero) { return run_as<decltype(zero)>(kernel, cells); });
}

template <typename Number>
std::vector<Field> HostileInputs::run_as(const Kernel& kernel, const Patch& cells) const {
    std::vector<const Number*> fields;
    for (const Field& field : fields_) fields.push_back(field.origin<Number>());
    std::vector<const std::uint8_t*> masks;
    for (const Mask& mask : masks_) masks.push_back(mask.origin());
    std::vector<Field> results;
    std::vector<Number*> targets;
    for (std::size_t k = 0; k < result_count_; ++k) {
        results.emplace_back(untouched_plane<Number>(PlaneLayout(grid_)));
        targets.push_back(results.back().origin<Number>());
    }
    std::vector<Number> uniforms;
    for (const std::uint64_t word : uniforms_) {
        uniforms.push_back(std::bit_cast<Number>(static_cast<WordOf<Number>>(word)));
    }
    const FlushDenormals environment;
    const LinkTable<Number> links = grid_.linked ? links_.table<Number>() : LinkTable<Number>{};
    kernel.run({fields, masks, uniforms, targets, PlaneLayout(grid_), links, is_near_, columns_},
               cells);
    return results;
}

std::vector<Field> run_kernel(Backend& backend, const CellKernel& kernel, const Grid& grid,
                              std::uint64_t seed) {
    const Result<KernelPointer> compiled = backend.compile(kernel, grid.stencil());
    CHECK(compiled, "test: the backend compiles every kernel");
    return HostileInputs(kernel, grid, seed).run(**compiled);
}

namespace {

template <typename Number>
std::string difference(const Plane<Number>& a, const Plane<Number>& b) {
    const auto same = [](Number x, Number y) {
        using Word = WordOf<Number>;
        return std::bit_cast<Word>(x) == std::bit_cast<Word>(y) || (std::isnan(x) && std::isnan(y));
    };
    for (std::int64_t j = 0; j < a.layout().row_count(); ++j) {
        for (std::int64_t i = 0; i < a.layout().width; ++i) {
            const Number x = a.row(j)[i], y = b.row(j)[i];
            if (same(x, y)) continue;
            return fmt::format("column {}, row {}: {:a} ({}) and {:a} ({})", i, j, x, x, y, y);
        }
    }
    return "";
}

}  // namespace

std::string same_bits(const std::vector<Field>& a, const std::vector<Field>& b) {
    if (a.size() != b.size()) return fmt::format("{} and {} results", a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        const PlaneLayout& layout = a[k].layout();
        if (!(layout == b[k].layout())) return fmt::format("result {}: other layout", k);
        if (a[k].precision() != b[k].precision()) return fmt::format("result {}: precisions", k);
        const std::string place = with_number(a[k].precision(), [&](auto zero) {
            return difference(a[k].plane<decltype(zero)>(), b[k].plane<decltype(zero)>());
        });
        if (!place.empty()) return fmt::format("result {}, {}", k, place);
    }
    return "";
}

namespace {

bool is_untouched(const Field& field, std::int64_t i, std::int64_t j, std::int64_t slice) {
    return field.visit([&](const auto& plane) {
        const auto number = plane.at(i, j, slice);
        using Number = std::remove_const_t<decltype(number)>;
        return std::bit_cast<WordOf<Number>>(number) == untouched<Number>;
    });
}

}  // namespace

std::string stray_writes(const std::vector<Field>& results, const Patch& cells, bool with_columns) {
    for (std::size_t k = 0; k < results.size(); ++k) {
        const PlaneLayout& layout = results[k].layout();
        const std::int64_t pad = PlaneLayout::row_pad;
        const ColumnRange columns = cells.columns.within((layout.width + pad - 1) / pad * pad);
        const std::int64_t halo = layout.has_halo_slices() ? 1 : 0;
        for (std::int64_t row = -layout.slice_rows() * halo - 1;
             row <= layout.slice_rows() * (layout.depth - 1 + halo) + layout.height; ++row) {
            // The loop goes over all rows of memory, including rows of the halo.
            const std::int64_t slice = (row + 1 + layout.slice_rows()) / layout.slice_rows() - 1;
            const std::int64_t j = row - slice * layout.slice_rows();
            const std::int64_t number = slice * layout.height + j;
            const bool is_computed = 0 <= j && j < layout.height && cells.rows.begin <= number &&
                                     number < cells.rows.end;
            for (std::int64_t i = -pad; i < layout.stride - pad; ++i) {
                if (is_computed && columns.contains(i)) continue;
                if (is_computed && with_columns && (i == -1 || i == layout.width)) continue;
                if (is_untouched(results[k], i, j, slice)) continue;
                return fmt::format("result {}: column {}, row {}, slice {} was written", k, i, j,
                                   slice);
            }
        }
    }
    return "";
}

Grid random_linked_grid(std::uint64_t seed, std::int64_t max_width, std::int64_t max_height) {
    Grid grid = random_grid(seed, max_width, max_height);
    grid.linked = true;
    return grid;
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

}  // namespace cascade::test
