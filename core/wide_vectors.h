// Functions that use the widest vectors of the processor they run on.
#pragma once

#include <cstddef>  // Defines __GLIBC__ if the C library is glibc.

/// Compiles a function for several widths of vectors. At program start, the processor's features
/// decide which version runs. Only for functions whose results do not depend on the width of
/// vectors. The thread sanitizer would instrument the code that chooses the version, which runs
/// before the sanitizer has started. Clang 19 does not emit inline functions, such as constructors,
/// that are called only by a function compiled this way.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__clang__)
#define WITH_WIDE_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WITH_WIDE_VECTORS
#endif
