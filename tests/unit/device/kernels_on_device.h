// Runs printed kernels on a device as if a backend had compiled them.
#pragma once

#include "device/kernel_text.h"
#include "device/opencl_device.h"
#include "ir/backend.h"

#include <memory>
#include <string>
#include <vector>

namespace cascade::test {

/// The device on which the tests run: PoCL's, which computes on the processor.
OpenDevice& tested_device();

/// Many kernels for one grid, compiled as one program.
class KernelsOnDevice {
public:
    KernelsOnDevice(OpenDevice& device, const std::vector<CellKernel>& kernels, const Grid& grid,
                    const TextTarget& target);

    const std::string& source() const { return source_; }
    /// Kernel number k. It runs on all cells of the grid.
    std::unique_ptr<Kernel> kernel(std::size_t k) const;

private:
    OpenDevice& device_;
    Grid grid_;
    std::string source_;
    DeviceProgram program_;
};

}  // namespace cascade::test
