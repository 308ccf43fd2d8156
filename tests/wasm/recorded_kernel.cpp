// Lays out the memory for a call of a kernel, as a host of WebAssembly modules does.
#include "tests/wasm/recorded_kernel.h"

#include "core/check.h"
#include "ir/interpreter.h"
#include "wasm/kernel_module.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <utility>

namespace cascade::test {
namespace {

/// The memory of a module while it is being filled. Addresses are multiples of 64 bytes, and 0
/// means no address.
class Image {
public:
    template <typename T>
    std::uint32_t add(const T* data, std::size_t count) {
        if (!data) return 0;
        bytes.resize((bytes.size() + alignment - 1) / alignment * alignment);
        const std::size_t address = bytes.size();
        bytes.resize(address + count * sizeof(T));
        std::memcpy(bytes.data() + address, data, count * sizeof(T));
        return static_cast<std::uint32_t>(address);
    }
    template <typename T>
    std::uint32_t add(const std::vector<T>& list) {
        return add(list.data(), list.size());
    }

    static constexpr std::size_t alignment = 64;
    std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(alignment);
};

/// A copy of all memory of a plane.
template <typename T>
std::vector<T> copy_of(const T* origin, const PlaneLayout& layout) {
    const T* first = origin - layout.offset(0, 0);
    return {first, first + layout.size()};
}

class RecordedKernel final : public Kernel {
public:
    RecordedKernel(const CellKernel& kernel, Stencil stencil, Recording recording, CaseFile& file)
        : stencil_(stencil), recording_(std::move(recording)), file_(file) {
        interpreted_ = *make_interpreter()->compile(kernel, stencil);
        const auto module = wasm_module(kernel, stencil, {recording_.is_exact});
        CHECK(module, "test: a kernel becomes a module");
        module_ = *module;
        for (const Instruction& instruction : kernel.code) {
            if (instruction.op == Op::link_weighted)
                of_links_.insert(Flow::with(instruction.payload).factor.index());
        }
        if (!recording_.is_in_place) return;
        const auto sole = sole_results(kernel);
        for (const FieldSlot slot : sole.ids()) {
            if (sole[slot]) field_of_result_[*sole[slot]] = slot;
        }
    }

    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        record(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        record(arguments, cells);
    }

private:
    template <typename Number>
    struct Result {
        std::uint32_t address;
        std::vector<Number> numbers;
    };

    template <typename Number>
    void record(const KernelArgumentsOf<Number>& given, const Patch& cells) const {
        const PlaneLayout& layout = given.layout;
        const std::size_t first = static_cast<std::size_t>(layout.offset(0, 0));
        const ColumnRange columns = cells.columns.within(layout.width);
        Image image;
        std::vector<std::uint32_t> fields, masks, places;
        for (std::size_t k = 0; k < given.fields.size(); ++k) {
            std::vector<Number> copy;
            if (of_links_.contains(k)) {
                const auto numbers = static_cast<std::ptrdiff_t>(first);
                const auto links = static_cast<std::ptrdiff_t>(link_count(given.links, layout));
                copy.assign(given.fields[k] - numbers, given.fields[k] + links);
            } else {
                copy = copy_of(given.fields[k], layout);
            }
            fields.push_back(image.add(copy));
        }
        for (const std::uint8_t* mask : given.masks) {
            masks.push_back(image.add(copy_of(mask, layout)));
        }
        std::vector<Result<Number>> results;
        for (std::size_t k = 0; k < given.results.size(); ++k) {
            const auto field = field_of_result_.find(k);
            if (field != field_of_result_.end()) {
                results.push_back({fields[field->second.index()],
                                   copy_of(given.fields[field->second.index()], layout)});
            } else {
                const auto before = copy_of<Number>(given.results[k], layout);
                results.push_back({image.add(before), before});
            }
            places.push_back(results.back().address);
        }
        const auto origins = [&](std::vector<std::uint32_t> planes, std::size_t bytes) {
            for (std::uint32_t& plane : planes) plane += static_cast<std::uint32_t>(first * bytes);
            return image.add(planes);
        };
        std::vector<std::uint32_t> shared{origins(fields, sizeof(Number)), origins(masks, 1),
                                          image.add(given.uniforms.data(), given.uniforms.size()),
                                          origins(places, sizeof(Number))};
        for (const std::int64_t count : {columns.begin, columns.end, layout.stride}) {
            shared.push_back(static_cast<std::uint32_t>(count));
        }
        const bool is_filled = given.columns && !stencil_.z && !stencil_.links &&
                               columns.begin == 0 && columns.end == layout.width;
        const HaloColumns filled = is_filled ? *given.columns : HaloColumns{-1, -1};
        const auto calls = calls_of(shared, given, cells.rows, filled, image);

        interpreted_->run(given, cells);
        file_.write(recording_.name);
        file_.write(module_);
        file_.write(image.bytes);
        file_.write(static_cast<std::uint32_t>(calls.size()));
        for (const auto& call : calls) file_.write(call);
        file_.write(sizeof(Number));
        file_.write(static_cast<std::uint32_t>(results.size()));
        for (std::size_t k = 0; k < results.size(); ++k) {
            std::vector<std::uint8_t> is_free(static_cast<std::size_t>(layout.size()));
            for (std::int64_t row = cells.rows.begin; row < cells.rows.end; ++row) {
                const std::int64_t start = layout.row_start(row);
                constexpr std::int64_t pad = PlaneLayout::row_pad;
                const std::int64_t end = (columns.end + pad - 1) / pad * pad;
                const auto place = [&](std::int64_t i) {
                    return first + static_cast<std::size_t>(start + i);
                };
                for (std::int64_t i = columns.begin; i < end; ++i) {
                    if (i < columns.end) results[k].numbers[place(i)] = given.results[k][start + i];
                    is_free[place(i)] = i >= columns.end;
                }
                if (!is_filled) continue;
                results[k].numbers[place(-1)] = given.results[k][start + filled.left];
                results[k].numbers[place(columns.end)] = given.results[k][start + filled.right];
                is_free[place(columns.end)] = 0;
            }
            file_.write(results[k].address);
            Image expected;
            expected.bytes.clear();
            expected.add(results[k].numbers);
            file_.write(expected.bytes);
            file_.write(is_free);
        }
        ++file_.cases;
    }

    /// The arguments of all calls, as bytes. On a grid in space there is a call for each slice that
    /// contains some of the rows.
    template <typename Number>
    std::vector<std::vector<std::uint8_t>> calls_of(const std::vector<std::uint32_t>& shared,
                                                    const KernelArgumentsOf<Number>& given,
                                                    RowRange rows, HaloColumns filled,
                                                    Image& image) const {
        std::vector<std::vector<std::uint8_t>> calls;
        const auto call = [&](std::int64_t begin, std::int64_t end,
                              const std::vector<std::uint32_t>& more) {
            std::vector<std::uint32_t> numbers = shared;
            numbers.push_back(static_cast<std::uint32_t>(begin));
            numbers.push_back(static_cast<std::uint32_t>(end));
            numbers.insert(numbers.end(), more.begin(), more.end());
            std::vector<std::uint8_t>& bytes = calls.emplace_back(4 * numbers.size());
            std::memcpy(bytes.data(), numbers.data(), bytes.size());
        };
        const PlaneLayout& layout = given.layout;
        if (stencil_.links) {
            call(rows.begin, rows.end, add_links(given.links, layout, image));
        } else if (!stencil_.z) {
            call(rows.begin, rows.end,
                 {static_cast<std::uint32_t>(filled.left),
                  static_cast<std::uint32_t>(filled.right)});
        } else {
            while (!rows.empty()) {
                const std::int64_t slice = rows.begin / layout.height;
                const std::int64_t end = std::min(rows.end, (slice + 1) * layout.height);
                const std::int64_t halo_rows = slice * (layout.slice_rows() - layout.height);
                call(rows.begin + halo_rows, end + halo_rows,
                     {static_cast<std::uint32_t>(layout.slice_rows()),
                      static_cast<std::uint32_t>(slice)});
                rows.begin = end;
            }
        }
        return calls;
    }

    template <typename Number>
    static std::size_t link_count(const LinkTable<Number>& links, const PlaneLayout& layout) {
        constexpr std::int64_t cells = LinkTable<Number>::slice_cells;
        const std::int64_t slices = (layout.width + cells - 1) / cells * layout.height;
        return links.starts[slices] * static_cast<std::size_t>(cells);
    }

    template <typename Number>
    static std::vector<std::uint32_t> add_links(const LinkTable<Number>& links,
                                                const PlaneLayout& layout, Image& image) {
        constexpr std::int64_t cells = LinkTable<Number>::slice_cells;
        const std::int64_t slices = (layout.width + cells - 1) / cells * layout.height;
        const std::size_t entries = links.starts[slices];
        const std::size_t count = entries * static_cast<std::size_t>(cells);
        return {image.add(links.starts, static_cast<std::size_t>(slices + 1)),
                image.add(links.bases, entries),
                image.add(links.offsets, count),
                image.add(links.weights, count),
                image.add(links.gradients[0], count),
                image.add(links.gradients[1], count),
                image.add(links.gradients[2], count),
                image.add(links.filled, entries)};
    }

    Stencil stencil_;
    Recording recording_;
    CaseFile& file_;
    KernelPointer interpreted_;
    std::vector<std::uint8_t> module_;
    std::set<std::size_t> of_links_;  ///< The fields with a number for each link.
    std::map<std::size_t, FieldSlot> field_of_result_;
};

}  // namespace

KernelPointer recorded_kernel(const CellKernel& kernel, Stencil stencil, const Recording& recording,
                              CaseFile& file) {
    return std::make_shared<RecordedKernel>(kernel, stencil, recording, file);
}

}  // namespace cascade::test
