// Libraries that are loaded at their first use.
#include "core/late_library.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

TEST(LateLibrary, FindsFunctions) {
    double (*cosine)(double) = LateLibrary("libm.so.6")["cos"];
    EXPECT_EQ(cosine(0), 1);
}

TEST(LateLibraryDeath, NamesWhatIsMissing) {
    EXPECT_DEATH(LateLibrary("libnone.so.7"), "libnone.so.7");
    EXPECT_DEATH(LateLibrary("libm.so.6")["no_such_function"], "libm.so.6.*no_such_function");
}

}  // namespace
}  // namespace cascade
