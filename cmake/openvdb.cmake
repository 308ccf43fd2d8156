# Builds the module that writes volumes as .vdb files (picture/vdb.h), if OpenVDB is installed.
# Debian's package has no CMake files. Everything else works without the module.

find_path(OPENVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OPENVDB_LIBRARY openvdb)
find_library(TBB_LIBRARY tbb)
find_package(Imath 3 QUIET CONFIG)
if(OPENVDB_INCLUDE_DIR AND OPENVDB_LIBRARY AND TBB_LIBRARY AND Imath_FOUND)
  add_library(cascade_with_openvdb INTERFACE)
  target_include_directories(cascade_with_openvdb SYSTEM INTERFACE ${OPENVDB_INCLUDE_DIR})
  # OpenVDB's templates share static variables with its library. Hidden symbols would duplicate
  # these variables.
  target_compile_options(cascade_with_openvdb INTERFACE -fvisibility=default -fno-visibility-inlines-hidden)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # Boost 1.74 computes values beyond those of an enumeration, which is an error since clang 16.
    target_compile_options(cascade_with_openvdb INTERFACE -Wno-enum-constexpr-conversion)
  endif()
  target_link_libraries(cascade_with_openvdb INTERFACE ${OPENVDB_LIBRARY} ${TBB_LIBRARY} Imath::Imath Boost::headers)

  add_library(cascade_openvdb MODULE ${PROJECT_SOURCE_DIR}/picture/openvdb_module.cpp)
  target_link_libraries(cascade_openvdb PRIVATE cascade_options cascade_core cascade_with_openvdb)
  target_link_options(cascade_openvdb PRIVATE LINKER:--exclude-libs,ALL)
  # With -O1 OpenVDB's templates compile in two thirds of the time, and its speed hardly matters for
  # writing files.
  target_compile_options(cascade_openvdb PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(cascade_openvdb PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_compile_definitions(cascade_picture PRIVATE CASCADE_OPENVDB_MODULE="libcascade_openvdb.so")
  add_dependencies(cascade_picture cascade_openvdb)
endif()
