// Aggregates, norms and checks of planes on a device, in the same order as threads compute them.
#pragma once

#include "device/device.h"
#include "ir/reduction.h"

#include <cstdint>
#include <vector>

namespace cascade {

/// A plane of a buffer. `origin` is the element of cell (0, 0, 0).
struct DevicePlane {
    const DeviceBuffer& buffer;
    std::int64_t origin = 0;
};

class DeviceSums {
public:
    DeviceSums(Device& device, const TextTarget& target, const PlaneLayout& layout);

    /// Writes an aggregate, rounded, to word `number` of `aggregates`. `cells` is the number of
    /// cells over which a mean is taken.
    void reduce(ReductionKind kind, const DevicePlane& plane, std::int64_t cells,
                const DeviceBuffer& aggregates, std::uint32_t number);
    /// The sums of squares of all rows. Cells from number `counted` on count as 0.
    std::vector<double> squares(const DevicePlane& plane, std::int64_t counted);

private:
    std::size_t row_count() const { return static_cast<std::size_t>(layout_.row_count()); }

    OpenDevice& device_;
    PlaneLayout layout_;
    DeviceKernel row_parts_, row_values_, fold_rows_, row_squares_, square_sums_;
    DeviceBuffer parts_, rows_, spare_;
};

class DeviceCheck {
public:
    DeviceCheck(Device& device, const TextTarget& target, const PlaneLayout& layout);

    /// Whether all cells of the first `planes` planes of a buffer are finite.
    bool are_finite(const DeviceBuffer& buffer, std::size_t planes);

private:
    OpenDevice& device_;
    PlaneLayout layout_;
    DeviceKernel kernel_;
    DeviceBuffer flag_;
};

}  // namespace cascade
