// Moves planes between this process and a device.
#include "device/device_planes.h"

#include "core/check.h"

#include <utility>

namespace cascade {

const void* memory_of(const Field& field) {
    return field.visit([](const auto& plane) -> const void* {
        return plane.origin() - plane.layout().offset(0, 0);
    });
}

void* memory_of(Field& field) {
    return field.visit(
        [](auto& plane) -> void* { return plane.origin() - plane.layout().offset(0, 0); });
}

DevicePlanes::DevicePlanes(OpenDevice& device, const PlaneLayout& layout, Precision precision,
                           std::size_t species, bool keeps)
    : device_(device), layout_(layout), precision_(precision), species_(species) {
    for (std::size_t k = 0; k < (keeps ? 3u : 2u); ++k) {
        copies_[k] = device_.buffer(species_ * plane_bytes());
    }
}

const DeviceBuffer& DevicePlanes::of(RegisterId id, CopyRoles roles) const {
    if (id == old_register) return copy(roles.current);
    return id == new_register ? copy(roles.target()) : scratch(id);
}

void DevicePlanes::make(std::uint32_t registers, std::uint32_t temporaries) {
    while (scratch_.size() + first_scratch_register.index() < registers) {
        scratch_.push_back(device_.buffer(species_ * plane_bytes()));
    }
    if (temporary_count_ >= temporaries && temporaries_.memory() != nullptr) return;
    temporary_count_ = temporaries;
    temporaries_ = device_.buffer(temporaries * plane_bytes());
}

void DevicePlanes::exchange(RegisterId one, RegisterId other) {
    const std::uint32_t first = first_scratch_register.index();
    std::swap(scratch_[one.index() - first], scratch_[other.index() - first]);
}

std::vector<Field> DevicePlanes::read(const DeviceBuffer& species) const {
    std::vector<Field> fields;
    for (std::size_t k = 0; k < species_; ++k) {
        Field& field = fields.emplace_back(layout_, precision_);
        device_.read(species, k * plane_bytes(), memory_of(field), plane_bytes());
    }
    return fields;
}

void DevicePlanes::write(const DeviceBuffer& to, const std::vector<Field>& species) {
    CHECK(species.size() == species_, "all species come back");
    for (std::size_t k = 0; k < species_; ++k) {
        CHECK(species[k].layout() == layout_ && species[k].precision() == precision_,
              "species lie as the grid says, in the precision of their problem");
        device_.write(to, k * plane_bytes(), memory_of(species[k]), plane_bytes());
    }
}

}  // namespace cascade
