// Finds out how a device computes: whether it flushes denormal numbers, and whether sums, products,
// quotients, roots and conversions have the same bits as the interpreter's results, on a table of
// difficult cases.
#pragma once

#include "device/opencl_device.h"
#include "device/prelude.h"

#include <string>

namespace cascade {

struct ProbeResult {
    TextTarget target;
    /// The first operation whose result has other bits than the interpreter's, with its operands.
    /// Empty if all results have the same bits.
    std::string fault;

    bool is_exact() const { return fault.empty(); }
};

/// Tries both ways to flush, the faster one first. Throws OpenclError and ProgramRefused.
ProbeResult probe(OpenDevice& device, Precision precision);

}  // namespace cascade
