# The library libcascade, its public headers, and the rules of `cmake --install`.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The rooms are linked in but not exported: programs can call only the functions of the public
# headers. These functions are an object library, which tests link, too.
file(GLOB library_sources CONFIGURE_DEPENDS library/*.cpp)
add_library(cascade_pattern OBJECT ${library_sources})
target_link_libraries(cascade_pattern PUBLIC cascade_view)
target_compile_options(cascade_pattern PRIVATE ${usual_options})
add_library(cascade_library SHARED $<TARGET_OBJECTS:cascade_pattern>)
set_target_properties(cascade_library PROPERTIES LINKER_LANGUAGE CXX)
target_link_libraries(cascade_library PRIVATE cascade_view)
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
  INSTALL_RPATH "$ORIGIN/cascade;$ORIGIN")
add_library(Cascade::cascade ALIAS cascade_library)

file(RELATIVE_PATH libraries_from_programs
  ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
# The program and the library are linked with their final search path from the start. Otherwise
# CMake would end a path that it will replace with an empty entry, which the loader takes for the
# current folder. In the build folder the module is beside both.
set_target_properties(cascade_program PROPERTIES
  INSTALL_RPATH "$ORIGIN/${libraries_from_programs}/cascade;$ORIGIN")
set_target_properties(cascade_program cascade_library PROPERTIES BUILD_WITH_INSTALL_RPATH ON)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Cascade)
configure_package_config_file(cmake/CascadeConfig.cmake.in CascadeConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(CascadeConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(TARGETS cascade_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
foreach(module cascade_llvm cascade_openvdb cascade_hdf5 cascade_openmpi cascade_mpich cascade_sbml)
  if(TARGET ${module})
    cascade_install_module(${module})
  endif()
endforeach()
install(TARGETS cascade_library EXPORT CascadeTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  COMPONENT library NAMELINK_COMPONENT library)
install(FILES include/cascade/cascade.h include/cascade/cascade_c.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/cascade COMPONENT library)
install(EXPORT CascadeTargets NAMESPACE Cascade:: DESTINATION ${package_folder} COMPONENT library)
install(FILES
  ${PROJECT_BINARY_DIR}/CascadeConfig.cmake
  ${PROJECT_BINARY_DIR}/CascadeConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT library)
