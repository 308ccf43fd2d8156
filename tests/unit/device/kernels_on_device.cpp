#include "tests/unit/device/kernels_on_device.h"

#include "core/check.h"
#include "device/build_options.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace cascade::test {
namespace {

/// A buffer on the device with room for `count` values, and with these values if they are given.
template <typename T>
DeviceBuffer buffer_of(OpenDevice& device, const T* values, std::size_t count) {
    DeviceBuffer made = device.buffer(count * sizeof(T));
    if (values != nullptr) device.write(made, 0, values, count * sizeof(T));
    return made;
}

class KernelOnDevice final : public Kernel {
public:
    KernelOnDevice(OpenDevice& device, DeviceKernel kernel, const Grid& grid)
        : device_(device), kernel_(std::move(kernel)), grid_(grid) {}

    void run(const KernelArgumentsOf<float>& arguments, const Patch& cells) const override {
        run_as(arguments, cells);
    }
    void run(const KernelArgumentsOf<double>& arguments, const Patch& cells) const override {
        run_as(arguments, cells);
    }

private:
    template <typename Number>
    void run_as(const KernelArgumentsOf<Number>& given, const Patch& cells) const {
        const PlaneLayout& layout = given.layout;
        CHECK(cells.rows.begin == 0 && cells.rows.end == layout.row_count(), "test: all cells");
        const auto size = static_cast<std::size_t>(layout.size());
        const std::size_t bytes = size * sizeof(Number);
        const auto first = layout.offset(0, 0);
        const DeviceBuffer planes =
            device_.buffer(bytes * (given.fields.size() + given.results.size()));
        std::size_t place = 0;
        for (const Number* field : given.fields) {
            device_.write(planes, bytes * place++, field - first, bytes);
        }
        for (const Number* result : given.results) {
            device_.write(planes, bytes * place++, result - first, bytes);
        }
        const DeviceBuffer masks = device_.buffer(size * given.masks.size());
        for (std::size_t k = 0; k < given.masks.size(); ++k) {
            device_.write(masks, size * k, given.masks[k] - first, size);
        }
        const DeviceBuffer uniforms =
            buffer_of(device_, given.uniforms.data(), given.uniforms.size());
        kernel_.begin();
        kernel_.add(planes);
        kernel_.add(masks);
        kernel_.add(uniforms);
        std::vector<DeviceBuffer> tables;
        if (grid_.linked) {
            const LinkTable<Number>& links = given.links;
            const auto slices =
                static_cast<std::size_t>((layout.width + 15) / 16 * layout.row_count());
            const std::size_t entries = links.starts[slices];
            tables.push_back(buffer_of(device_, links.starts, slices + 1));
            tables.push_back(buffer_of(device_, links.bases, entries));
            tables.push_back(buffer_of(device_, links.offsets, entries * 16));
            tables.push_back(buffer_of(device_, links.filled, entries));
            tables.push_back(buffer_of(device_, links.weights, entries * 16));
            for (const Number* of_axis : links.gradients) {
                tables.push_back(buffer_of(device_, of_axis, entries * 16));
            }
        }
        for (const DeviceBuffer& table : tables) kernel_.add(table);
        kernel_.add(WordOf<Number>{0});
        kernel_.add(std::int32_t{0});
        kernel_.add(static_cast<std::int32_t>(layout.row_count()));
        const auto columns = static_cast<std::size_t>((layout.width + 15) / 16 * 16);
        device_.launch(kernel_, columns, static_cast<std::size_t>(layout.row_count()),
                       device_.group_for(columns, 16));
        place = given.fields.size();
        for (Number* result : given.results) {
            device_.read(planes, bytes * place++, result - first, bytes);
        }
    }

    OpenDevice& device_;
    mutable DeviceKernel kernel_;
    Grid grid_;
};

}  // namespace

OpenDevice& tested_device() {
    static OpenDevice* const device = [] {
        auto found = find_devices();
        CHECK(found && !found->empty(), "tests need PoCL: apt-get install pocl-opencl-icd");
        return new OpenDevice(**opencl_api(), found->front());
    }();
    return *device;
}

KernelsOnDevice::KernelsOnDevice(OpenDevice& device, const std::vector<CellKernel>& kernels,
                                 const Grid& grid, const TextTarget& target)
    : device_(device), grid_(grid) {
    const PlaneLayout layout(grid);
    source_ = prelude_text(target) + stencil_text(target, grid.stencil(), layout);
    for (std::size_t number = 0; number < kernels.size(); ++number) {
        const CellKernel& kernel = kernels[number];
        KernelNames names;
        std::int64_t offset = layout.offset(0, 0);
        const auto plane = [&] {
            const std::string name = fmt::format("c_planes + {}", offset);
            offset += layout.size();
            return name;
        };
        for (std::size_t k = 0; k < kernel.field_names.size(); ++k) names.fields.push_back(plane());
        for (std::size_t k = 0; k < kernel.results.size(); ++k) names.results.push_back(plane());
        for (std::size_t k = 0; k < kernel.mask_names.size(); ++k) {
            names.masks.push_back(
                fmt::format("c_masks + {}",
                            static_cast<std::int64_t>(k) * layout.size() + layout.offset(0, 0)));
        }
        for (std::size_t k = 0; k < kernel.uniform_names.size(); ++k) {
            names.uniforms.push_back(fmt::format("c_uniforms[{}]", k));
        }
        source_ += fmt::format(
            "__kernel void c_kernel_{}(__global cw* c_planes, __global const uchar* c_masks, "
            "__global const cw* c_uniforms{}, const cw c_pad, const int c_first_row, "
            "const int c_last_row) {{\n",
            number, link_parameters(target, grid.linked));
        source_ += cells_begin(target, grid.stencil(), layout, 1);
        source_ += cell_text(kernel, names, target, grid.stencil(), layout);
        source_ += std::string(cells_end) + "}\n";
    }
    try {
        program_ = device.build(source_, build_options(target, device.facts()));
    } catch (const ProgramRefused& refusal) {
        throw std::runtime_error(refusal.log + "\n" + source_);
    }
}

std::unique_ptr<Kernel> KernelsOnDevice::kernel(std::size_t k) const {
    return std::make_unique<KernelOnDevice>(device_, program_.kernel(fmt::format("c_kernel_{}", k)),
                                            grid_);
}

}  // namespace cascade::test
