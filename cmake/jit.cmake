# The room jit/ has two parts. The part that finds, stores and runs compiled kernels is linked into
# every program. The part that needs LLVM is a module, which is loaded to generate code
# (jit/generator.h).

set(jit_without_llvm code_cache code_image code_version generator jit kernel_key processor)
list(TRANSFORM jit_without_llvm PREPEND ${PROJECT_SOURCE_DIR}/jit/)
list(TRANSFORM jit_without_llvm APPEND .cpp)
file(GLOB jit_with_llvm CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/jit/*.cpp)
list(REMOVE_ITEM jit_with_llvm ${jit_without_llvm} ${PROJECT_SOURCE_DIR}/jit/no_jit.cpp)

# A program reuses kernels on disk only if the same code generator made them.
file(GLOB code_sources RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/jit/*.cpp
  ${PROJECT_SOURCE_DIR}/jit/*.h ${PROJECT_SOURCE_DIR}/ir/*.cpp ${PROJECT_SOURCE_DIR}/ir/*.h
  ${PROJECT_SOURCE_DIR}/ir/*.def ${PROJECT_SOURCE_DIR}/core/grid.h
  ${PROJECT_SOURCE_DIR}/core/links.h ${PROJECT_SOURCE_DIR}/core/plane.h)
list(JOIN code_sources "," code_sources_text)
set(code_version_folder ${PROJECT_BINARY_DIR}/generated)
add_custom_command(
  OUTPUT ${code_version_folder}/jit/code_version.h
  COMMAND ${CMAKE_COMMAND} -DFOLDER=${PROJECT_SOURCE_DIR} -DSOURCES=${code_sources_text}
    "-DEXTRA=LLVM ${LLVM_PACKAGE_VERSION}"
    -DTEMPLATE=${PROJECT_SOURCE_DIR}/jit/code_version.h.in
    -DOUTPUT=${code_version_folder}/jit/code_version.h -P ${PROJECT_SOURCE_DIR}/cmake/code_version.cmake
  DEPENDS ${code_sources} ${PROJECT_SOURCE_DIR}/jit/code_version.h.in
    ${PROJECT_SOURCE_DIR}/cmake/code_version.cmake
  VERBATIM)
add_custom_target(cascade_code_version DEPENDS ${code_version_folder}/jit/code_version.h)

# Both parts contain this file. It is compiled by itself, so that a program that links both parts
# takes only one copy.
set(code_version ${PROJECT_SOURCE_DIR}/jit/code_version.cpp)
set_source_files_properties(${code_version} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

add_library(cascade_jit STATIC)
cascade_compile(cascade_jit ${jit_without_llvm})
target_link_libraries(cascade_jit PUBLIC cascade_options cascade_ir cascade_core ${CMAKE_DL_LIBS})
target_include_directories(cascade_jit PRIVATE ${code_version_folder})
get_target_property(llvm_library LLVM LOCATION)
target_compile_definitions(cascade_jit PRIVATE
  CASCADE_LLVM_MODULE="libcascade_llvm.so" CASCADE_LLVM_LIBRARY="${llvm_library}"
  CASCADE_LLVM_VERSION="${LLVM_PACKAGE_VERSION}")

# Tests call the parts of the module directly, without its table of functions.
set(llvm_module ${PROJECT_SOURCE_DIR}/jit/llvm_module.cpp)
list(REMOVE_ITEM jit_with_llvm ${llvm_module})
add_library(cascade_llvm_parts STATIC)
cascade_compile(cascade_llvm_parts ${jit_with_llvm} ${code_version})
set(llvm_objects cascade_llvm_parts_first)
set_target_properties(${llvm_objects} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)  # LLVM's macros come first.
target_link_libraries(cascade_llvm_parts PUBLIC cascade_options cascade_ir cascade_core)
target_include_directories(cascade_llvm_parts PRIVATE ${code_version_folder})
cascade_link_llvm(cascade_llvm_parts)
cascade_link_llvm(${llvm_objects})
add_dependencies(${llvm_objects} cascade_code_version)

add_library(cascade_llvm MODULE ${llvm_module})
target_link_libraries(cascade_llvm PRIVATE cascade_llvm_parts)
cascade_link_llvm(cascade_llvm)
target_link_options(cascade_llvm PRIVATE LINKER:--exclude-libs,ALL)
set_target_properties(cascade_llvm PROPERTIES
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
add_dependencies(cascade_jit cascade_llvm)
add_dependencies(cascade_jit_first cascade_code_version)
