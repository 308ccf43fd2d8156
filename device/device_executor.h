// Takes steps on a device.
#pragma once

#include "device/opencl_device.h"
#include "solvers/step_problem.h"

#include <string>

namespace cascade {

/// The reason why a device cannot run the steps of a problem, worded to follow "because". Empty if
/// the device can run them.
std::string reason_against(const StepProblem& problem, const DeviceFacts& facts);

}  // namespace cascade
