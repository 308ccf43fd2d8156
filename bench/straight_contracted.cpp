// The straight C++ compiled with the flags of straight_contracted in CMakeLists.txt.
#define STRAIGHT_CPP_FLAVOUR straight_contracted
#include "bench/straight_cpp_steps.h"
