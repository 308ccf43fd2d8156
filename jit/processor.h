// Facts about this machine's processor that affect the code made for it.
//
// Internal to jit/. Found without LLVM, because loading LLVM takes longer than a small run.
#pragma once

#include <string>

namespace cascade {

/// The number of floats in the widest vectors of this processor: 4, 8 or 16.
int host_lanes();

/// Bytes that differ between processors if LLVM may write different code for them: maker, family,
/// model and features. Empty if unknown.
std::string host_identity();

/// The identity of an ARM processor, from the text of Linux's /proc/cpuinfo, which LLVM reads, too:
/// maker, part, variant, revision and features of each kind of core.
std::string kinds_of_cores(const std::string& cpuinfo);

}  // namespace cascade
