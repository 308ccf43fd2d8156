// The straight C++ compiled with the flags of straight_strict in CMakeLists.txt.
#define STRAIGHT_CPP_FLAVOUR straight_strict
#include "bench/straight_cpp_steps.h"
