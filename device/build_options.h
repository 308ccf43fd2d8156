// The options with which programs are compiled.
#pragma once

#include "device/opencl_device.h"
#include "device/prelude.h"

#include <string>

namespace cascade {

/// Options for programs of a target on a device. They include no option that lets the device change
/// bits of results, such as -cl-mad-enable.
inline std::string build_options(const TextTarget& target, const DeviceFacts& facts) {
    std::string options = "-cl-std=CL1.2 -w";
    if (target.flushing == Flushing::by_device) options += " -cl-denorms-are-zero";
    if (facts.promises_division) options += " -cl-fp32-correctly-rounded-divide-sqrt";
    return options;
}

}  // namespace cascade
