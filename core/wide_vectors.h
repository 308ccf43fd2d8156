// Functions that use the widest vectors of the processor they run on.
#pragma once

#include <cstddef>  // Defines __GLIBC__ where that is the library.

/// Compiles a function several times. The processor decides at program start which one runs. Only
/// for functions whose results do not depend on the width of vectors.
// The thread sanitizer would instrument the choice, which is made before it has started. Clang 19
// does not emit the inline functions that only such a function calls, such as constructors.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_THREAD__) && \
    !defined(__clang__)
#define WITH_WIDE_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WITH_WIDE_VECTORS
#endif
