# The room jit/ where there is no LLVM: everything in it fails, and says so.
add_library(cascade_jit STATIC)
cascade_compile(cascade_jit ${PROJECT_SOURCE_DIR}/jit/no_jit.cpp)
target_link_libraries(cascade_jit PUBLIC cascade_options cascade_ir cascade_core)
