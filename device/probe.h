// Finds out how a device computes: whether it flushes denormal numbers, and whether sums, products,
// quotients, roots and conversions have the bits that the interpreter computes, on a table of hard
// cases.
#pragma once

#include "device/opencl_device.h"
#include "device/prelude.h"

#include <string>

namespace cascade {

struct ProbeResult {
    TextTarget target;
    /// The first operation with other bits, with its operands; empty if all are right.
    std::string fault;

    bool is_exact() const { return fault.empty(); }
};

/// Tries the ways to flush, the faster first. Throws OpenclError and
/// ProgramRefused.
ProbeResult probe(OpenDevice& device, Precision precision);

}  // namespace cascade
