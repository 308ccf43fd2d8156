// Devices that take steps: graphics processors and others with a driver for OpenCL. This header
// does not need the headers of OpenCL.
#pragma once

#include "core/result.h"
#include "solvers/executor.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace cascade {

class Device;

/// Opens the device that the user has chosen: "gpu" or "cpu", the first of this kind, or the number
/// of a device in the list. Fails if there is no such device, no driver, or no loader of drivers.
Result<std::shared_ptr<Device>> open_device(std::string_view choice);

/// Two lines for each device: its number, kind, name, memory and driver, and whether its results
/// have the same bits as Cascade's. Opens and probes each device.
Result<std::string> list_devices();

/// Makes executors whose planes stay on the device. Problems that the device cannot run are run by
/// threads instead. For such a problem, `tell` (unless empty) is called with the end of a sentence
/// such as "runs on threads instead of NAME, because it has a convolution". It is also called if
/// the device's results may differ from Cascade's.
///
/// A device whose results have other bits than the interpreter's is refused unless `may_differ` is
/// true. The executors throw an ExecutorFailure if the device fails, or has too little memory.
MakeExecutor on_device(std::shared_ptr<Device> device, bool may_differ,
                       std::function<void(const std::string&)> tell);

}  // namespace cascade
