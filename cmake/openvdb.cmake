# The module that writes volumes as .vdb files (picture/vdb.h), where OpenVDB is installed. Debian's package has no
# CMake files. Without the module everything else works.

find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OPENVDB_LIBRARY openvdb)
find_library(TBB_LIBRARY tbb)
find_package(Imath 3 QUIET CONFIG)
if(OPENVDB_INCLUDE_DIR AND OPENVDB_LIBRARY AND TBB_LIBRARY AND Imath_FOUND)
  add_library(cascade_with_openvdb INTERFACE)
  target_include_directories(cascade_with_openvdb SYSTEM INTERFACE ${OPENVDB_INCLUDE_DIR})
  # Its templates share static variables with the library, which hidden symbols would double.
  target_compile_options(cascade_with_openvdb INTERFACE -fvisibility=default -fno-visibility-inlines-hidden)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # Boost 1.74 computes values next to those of an enumeration, an error since clang 16.
    target_compile_options(cascade_with_openvdb INTERFACE -Wno-enum-constexpr-conversion)
  endif()
  target_link_libraries(cascade_with_openvdb INTERFACE ${OPENVDB_LIBRARY} ${TBB_LIBRARY} Imath::Imath Boost::headers)

  add_library(cascade_openvdb MODULE ${PROJECT_SOURCE_DIR}/picture/openvdb_module.cpp)
  target_link_libraries(cascade_openvdb PRIVATE cascade_options cascade_core cascade_with_openvdb)
  target_link_options(cascade_openvdb PRIVATE LINKER:--exclude-libs,ALL)
  # Its templates compile in two thirds of the time, and writing is not where time goes.
  target_compile_options(cascade_openvdb PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(cascade_openvdb PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_compile_definitions(cascade_picture PRIVATE CASCADE_OPENVDB_MODULE="libcascade_openvdb.so")
  add_dependencies(cascade_picture cascade_openvdb)
endif()
