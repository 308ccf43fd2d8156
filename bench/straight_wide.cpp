// The straight C++ compiled with the flags of straight_wide in CMakeLists.txt.
#define STRAIGHT_CPP_FLAVOUR straight_wide
#include "bench/straight_cpp_steps.h"
