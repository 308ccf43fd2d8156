// Fills halos on a device.
#pragma once

#include "core/side.h"
#include "device/device.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// Planes of one buffer whose halos are filled together.
struct HaloGroup {
    /// The number of the element of cell (0, 0, 0) in each plane.
    std::vector<std::int64_t> origins;
    DeviceBuffer places, kinds, numbers, side_values;
};

class DeviceHalos {
public:
    DeviceHalos(Device& device, const TextTarget& target, const PlaneLayout& layout);

    /// Makes a group of planes with rules for the sides of each plane.
    HaloGroup group(std::vector<std::int64_t> origins, const std::vector<SideRules>& rules);
    /// Replaces the rules of all planes of a group.
    void set_rules(HaloGroup& group, const std::vector<SideRules>& rules);
    void fill(const DeviceBuffer& planes, const HaloGroup& group);

private:
    void launch(std::int64_t cells, std::int64_t planes, std::int64_t slices, bool is_slice,
                const DeviceBuffer& buffer, const HaloGroup& group);

    OpenDevice& device_;
    Precision precision_;
    PlaneLayout layout_;
    DeviceKernel kernel_;
};

/// Writes numbers as words of a precision into a buffer. If the buffer is too small, a larger one
/// replaces it.
void write_words(OpenDevice& device, DeviceBuffer& to, const std::vector<double>& numbers,
                 Precision precision);

}  // namespace cascade
