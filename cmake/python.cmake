# Builds `import cascade` (python/), if pybind11 and Python's headers are installed. Everything else
# works without it.

find_path(PYBIND11_INCLUDE_DIR pybind11/pybind11.h)
if(EXISTS /usr/bin/python3)
  # Takes Debian's Python, to which the packages pybind11-dev and python3-numpy belong.
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that imports cascade")
endif()
find_package(Python3 QUIET COMPONENTS Interpreter Development.Module)
if(PYBIND11_INCLUDE_DIR AND Python3_Development.Module_FOUND)
  file(GLOB python_sources CONFIGURE_DEPENDS python/*.cpp)
  Python3_add_library(cascade_python MODULE WITH_SOABI ${python_sources})
  target_include_directories(cascade_python SYSTEM PRIVATE ${PYBIND11_INCLUDE_DIR})
  target_link_libraries(cascade_python PRIVATE cascade_options Cascade::cascade)
  target_compile_options(cascade_python PRIVATE ${usual_options})
  # The module is in the same folder as the files in Python, both in the build folder and where it
  # is installed.
  set(python_folder lib/python3/dist-packages/cascade)
  file(RELATIVE_PATH library_from_python
    ${CMAKE_INSTALL_PREFIX}/${python_folder} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(cascade_python PROPERTIES
    OUTPUT_NAME _core
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python/cascade
    BUILD_WITH_INSTALL_RPATH ON
    INSTALL_RPATH "$ORIGIN/${library_from_python};$ORIGIN/../..")
  file(GLOB python_files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
    python/cascade/*.py python/cascade/*.pyi python/cascade/py.typed)
  foreach(file IN LISTS python_files)
    configure_file(${file} ${file} COPYONLY)
  endforeach()
  install(TARGETS cascade_python LIBRARY DESTINATION ${python_folder} COMPONENT python)
  install(FILES ${python_files} DESTINATION ${python_folder} COMPONENT python)
endif()
