// Passes the rules of sides to the kernel c_halo.
#include "device/device_halos.h"

#include "device/pass_values.h"
#include "device/plane_kernels.h"

#include <utility>

namespace cascade {

void write_words(OpenDevice& device, DeviceBuffer& to, const std::vector<double>& numbers,
                 Precision precision) {
    with_number(precision, [&](auto zero) {
        using Number = decltype(zero);
        std::vector<Number> rounded;
        for (const double number : numbers) rounded.push_back(static_cast<Number>(number));
        const std::size_t bytes = rounded.size() * sizeof(Number);
        if (to.memory() == nullptr || to.size() < bytes) to = device.buffer(bytes);
        device.write(to, 0, rounded.data(), bytes);
    });
}

DeviceHalos::DeviceHalos(Device& device, const TextTarget& target, const PlaneLayout& layout)
    : device_(device.open()),
      precision_(target.precision),
      layout_(layout),
      kernel_(device.program(plane_kernels_text(target), target).kernel("c_halo")) {}

HaloGroup DeviceHalos::group(std::vector<std::int64_t> origins,
                             const std::vector<SideRules>& rules) {
    HaloGroup group;
    group.origins = std::move(origins);
    const std::size_t bytes = group.origins.size() * sizeof(std::int64_t);
    group.places = device_.buffer(bytes);
    device_.write(group.places, 0, group.origins.data(), bytes);
    set_rules(group, rules);
    return group;
}

void DeviceHalos::set_rules(HaloGroup& group, const std::vector<SideRules>& rules) {
    const HaloRecords records(rules);
    const std::size_t bytes = records.kinds.size() * sizeof(std::int32_t);
    if (group.kinds.memory() == nullptr) group.kinds = device_.buffer(bytes);
    device_.write(group.kinds, 0, records.kinds.data(), bytes);
    write_words(device_, group.numbers, records.numbers, precision_);
    write_words(device_, group.side_values, records.values, precision_);
}

void DeviceHalos::fill(const DeviceBuffer& planes, const HaloGroup& group) {
    const auto count = static_cast<std::int64_t>(group.origins.size());
    if (count == 0) return;
    const std::int64_t around = 2 * (layout_.width + 2) + 2 * layout_.height;
    launch(around, count, layout_.depth, false, planes, group);
    if (!layout_.has_halo_slices()) return;
    launch((layout_.width + 2) * (layout_.height + 2), count, 2, true, planes, group);
}

void DeviceHalos::launch(std::int64_t cells, std::int64_t planes, std::int64_t slices,
                         bool is_slice, const DeviceBuffer& buffer, const HaloGroup& group) {
    kernel_.set(buffer, group.places, group.kinds, group.numbers, group.side_values,
                static_cast<std::int32_t>(layout_.width), static_cast<std::int32_t>(layout_.height),
                static_cast<std::int32_t>(layout_.depth), layout_.stride, layout_.slice_stride,
                std::int32_t{0}, static_cast<std::int32_t>(slices),
                static_cast<std::int32_t>(is_slice));
    const std::size_t groups = (static_cast<std::size_t>(cells) + halo_group - 1) / halo_group;
    device_.launch(kernel_, groups * halo_group, static_cast<std::size_t>(planes * slices),
                   halo_group);
}

}  // namespace cascade
