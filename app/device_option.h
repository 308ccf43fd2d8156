// Implements `cascade run --device`, which takes steps on graphics processors and other devices
// (docs/devices.md).
#pragma once

#include "app/console.h"
#include "core/result.h"
#include "core/run_control.h"
#include "run/commands/run.h"
#include "run/script/script.h"

#include <string>

namespace cascade {

/// Prints the devices that --device can name. Returns the exit status.
int print_devices(Console& console);

/// Lets a device take the steps of a run. `choice` is "gpu", "cpu" or a number. A device whose
/// results may differ in some bits from the results of threads is used only with --fast, and then
/// with a note. If the device cannot run some stages, prints a note for each different reason.
/// Fails if there is no such device. `control` must outlive the run.
Result<void> use_device(const std::string& choice, const Script& script, RunRequest& request,
                        RunControl& control);

}  // namespace cascade
