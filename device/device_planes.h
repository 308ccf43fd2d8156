// The planes of steps in a device's memory: the copies of all species, scratch registers and
// temporaries. Each register is one buffer, with the layout of the planes in this process.
#pragma once

#include "core/plane.h"
#include "device/opencl_device.h"
#include "solvers/executor.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

class DevicePlanes {
public:
    /// If `keeps` is true, there are three copies of the species, because one may be kept
    /// (CopyRoles::keep()). Otherwise there are two.
    DevicePlanes(OpenDevice& device, const PlaneLayout& layout, Precision precision,
                 std::size_t species, bool keeps);

    std::size_t species() const { return species_; }
    std::size_t plane_bytes() const { return Field::bytes(layout_, precision_); }
    const DeviceBuffer& copy(int number) const { return copies_[static_cast<std::size_t>(number)]; }
    const DeviceBuffer& scratch(RegisterId id) const {
        return scratch_[id.index() - first_scratch_register.index()];
    }
    const DeviceBuffer& temporaries() const { return temporaries_; }
    /// The buffer of a register in a step: the species before the step, the species after it, or
    /// scratch.
    const DeviceBuffer& of(RegisterId id, CopyRoles roles) const;

    /// Allocates the temporaries and scratch registers that a problem needs.
    void make(std::uint32_t registers, std::uint32_t temporaries);
    void exchange(RegisterId one, RegisterId other);

    std::vector<Field> read(const DeviceBuffer& species) const;
    void write(const DeviceBuffer& to, const std::vector<Field>& species);

private:
    OpenDevice& device_;
    PlaneLayout layout_;
    Precision precision_;
    std::size_t species_;
    std::array<DeviceBuffer, 3> copies_;
    std::vector<DeviceBuffer> scratch_;
    DeviceBuffer temporaries_;
    std::uint32_t temporary_count_ = 0;
};

/// The address of the first element of a plane's memory, halo included.
const void* memory_of(const Field& field);
void* memory_of(Field& field);

}  // namespace cascade
