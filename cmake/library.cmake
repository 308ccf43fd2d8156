# The library libcascade, its public headers, and the rules of `cmake --install`.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The rooms are linked in but not exported: only the functions of the public headers can be called.
# They are objects by themselves, which tests link, too.
add_library(cascade_pattern OBJECT
  run/commands/pattern.cpp run/commands/pattern_values.cpp
  run/commands/c_calls.cpp run/commands/c_functions.cpp run/commands/c_values.cpp)
target_link_libraries(cascade_pattern PRIVATE cascade_run)
target_compile_options(cascade_pattern PRIVATE ${usual_options})
add_library(cascade_library SHARED $<TARGET_OBJECTS:cascade_pattern>)
set_target_properties(cascade_library PROPERTIES LINKER_LANGUAGE CXX)
target_link_libraries(cascade_library PRIVATE cascade_run)
target_link_options(cascade_library PRIVATE LINKER:--exclude-libs,ALL)
target_include_directories(cascade_library INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(cascade_library INTERFACE cxx_std_17)
set_target_properties(cascade_library PROPERTIES
  OUTPUT_NAME cascade
  EXPORT_NAME cascade
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}
  INSTALL_RPATH "$ORIGIN")
add_library(Cascade::cascade ALIAS cascade_library)

file(RELATIVE_PATH libraries_from_programs
  ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
# Both are linked with their final path: CMake ends a path that it will replace with an empty entry, which
# means the current folder to the loader. In the build folder the module is beside them.
set_target_properties(cascade_program PROPERTIES
  INSTALL_RPATH "$ORIGIN/${libraries_from_programs};$ORIGIN")
set_target_properties(cascade_program cascade_library PROPERTIES BUILD_WITH_INSTALL_RPATH ON)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Cascade)
configure_package_config_file(cmake/CascadeConfig.cmake.in CascadeConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(CascadeConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(TARGETS cascade_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(CASCADE_JIT)
  install(TARGETS cascade_llvm LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
if(TARGET cascade_openvdb)
  install(TARGETS cascade_openvdb LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(TARGETS cascade_library EXPORT CascadeTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES include/cascade/cascade.h include/cascade/cascade_c.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cascade)
install(EXPORT CascadeTargets NAMESPACE Cascade:: DESTINATION ${package_folder})
install(FILES
  ${PROJECT_BINARY_DIR}/CascadeConfig.cmake
  ${PROJECT_BINARY_DIR}/CascadeConfigVersion.cmake
  DESTINATION ${package_folder})
