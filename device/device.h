// A device that was opened, with the results of its probes and the programs compiled for it.
#pragma once

#include "device/devices.h"
#include "device/opencl_device.h"
#include "device/prelude.h"
#include "device/probe.h"
#include "solvers/executor_failure.h"

#include <map>
#include <string>
#include <utility>

namespace cascade {

/// An opened device. Stores the results of its probes and its compiled programs. Throws OpenclError
/// and ProgramRefused.
class Device {
public:
    Device(const OpenclApi& api, FoundDevice found) : open_(api, std::move(found)) {}

    OpenDevice& open() { return open_; }
    const DeviceFacts& facts() const { return open_.facts(); }
    /// Finds the form of programs of a precision for this device, and whether the device's results
    /// have the same bits as Cascade's. The first call runs a small program.
    const ProbeResult& probe(Precision precision);
    /// Returns a compiled program. Equal programs are compiled once.
    const DeviceProgram& program(const std::string& source, const TextTarget& target);

private:
    OpenDevice open_;
    std::map<Precision, ProbeResult> probes_;
    std::map<std::string, DeviceProgram> programs_;
};

/// Converts an error of the device, or a program that its driver cannot compile, to a message for
/// users.
ExecutorFailure failure_of(const DeviceFacts& facts, const OpenclError& error);
ExecutorFailure failure_of(const DeviceFacts& facts, const ProgramRefused& refusal);

}  // namespace cascade
