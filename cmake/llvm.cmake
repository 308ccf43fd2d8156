# Finds LLVM 19's shared library. Its version file compares major.minor, so "19" alone does not
# match.
find_package(LLVM 19.1 REQUIRED CONFIG)

function(cascade_link_llvm target)
  separate_arguments(definitions NATIVE_COMMAND "${LLVM_DEFINITIONS}")
  target_include_directories(${target} SYSTEM PRIVATE ${LLVM_INCLUDE_DIRS})
  target_compile_definitions(${target} PRIVATE ${definitions})
  target_link_libraries(${target} PRIVATE LLVM)
endfunction()
