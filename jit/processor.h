// The processor of this machine, as far as it decides what code is made for it.
//
// Internal to jit/. All that can be told without LLVM, which takes longer to load than a small run.
#pragma once

#include <string>

namespace cascade {

/// Floats in the widest vector that this processor computes with: 4, 8 or 16.
int host_lanes();

/// Bytes that differ between processors for which LLVM may write different code: maker, family,
/// model and features. Empty where they are not known.
std::string host_identity();

/// The same of an ARM processor, from the text of Linux's /proc/cpuinfo, by which LLVM knows it:
/// maker, part, variant, revision and features of each kind of core.
std::string kinds_of_cores(const std::string& cpuinfo);

}  // namespace cascade
