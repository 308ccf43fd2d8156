// The facts about this machine's processor that affect code made for it.
//
// Internal to jit/. They are found without LLVM, which takes longer to load than a small run.
#pragma once

#include <string>

namespace cascade {

/// Floats in the widest vector that this processor computes with: 4, 8 or 16.
int host_lanes();

/// Bytes that differ between processors for which LLVM may write different code: maker, family,
/// model and features. Empty if unknown.
std::string host_identity();

/// The same for an ARM processor, from the text of Linux's /proc/cpuinfo, by which LLVM knows it:
/// maker, part, variant, revision and features of each kind of core.
std::string kinds_of_cores(const std::string& cpuinfo);

}  // namespace cascade
