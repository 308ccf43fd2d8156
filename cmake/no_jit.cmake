# Builds the room jit/ without LLVM. Its functions then fail with a message that says so.
add_library(cascade_jit STATIC)
cascade_compile(cascade_jit ${PROJECT_SOURCE_DIR}/jit/no_jit.cpp)
target_link_libraries(cascade_jit PUBLIC cascade_options cascade_ir cascade_core)
