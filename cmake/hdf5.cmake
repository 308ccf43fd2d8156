# Builds the module that writes series as .h5 files (picture/hdf5.h), if HDF5 is installed. Everything
# else works without the module.

find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5)
find_library(HDF5_HL_LIBRARY NAMES hdf5_serial_hl hdf5_hl)
if(HDF5_INCLUDE_DIR AND HDF5_LIBRARY AND HDF5_HL_LIBRARY)
  add_library(cascade_hdf5 MODULE ${PROJECT_SOURCE_DIR}/picture/hdf5_module.cpp ${PROJECT_SOURCE_DIR}/picture/hdf5_driver.cpp)
  target_include_directories(cascade_hdf5 SYSTEM PRIVATE ${HDF5_INCLUDE_DIR})
  target_link_libraries(cascade_hdf5 PRIVATE cascade_options cascade_core ${HDF5_HL_LIBRARY} ${HDF5_LIBRARY})
  target_link_options(cascade_hdf5 PRIVATE LINKER:--exclude-libs,ALL)
  set_target_properties(cascade_hdf5 PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_compile_definitions(cascade_picture PRIVATE CASCADE_HDF5_MODULE="libcascade_hdf5.so")
  add_dependencies(cascade_picture cascade_hdf5)
endif()
