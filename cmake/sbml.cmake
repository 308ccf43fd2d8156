# Builds the module that reads models in SBML (import/sbml.h), if libSBML is installed. Debian's package
# has no CMake files. Everything else works without the module.

find_path(SBML_INCLUDE_DIR sbml/SBMLTypes.h)
find_library(SBML_LIBRARY sbml)
if(SBML_INCLUDE_DIR AND SBML_LIBRARY)
  add_library(cascade_sbml MODULE ${PROJECT_SOURCE_DIR}/import/sbml_module.cpp)
  target_include_directories(cascade_sbml SYSTEM PRIVATE ${SBML_INCLUDE_DIR})
  target_link_libraries(cascade_sbml PRIVATE cascade_options cascade_core ${SBML_LIBRARY})
  target_link_options(cascade_sbml PRIVATE LINKER:--exclude-libs,ALL)
  set_target_properties(cascade_sbml PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_compile_definitions(cascade_import PRIVATE CASCADE_SBML_MODULE="libcascade_sbml.so")
  add_dependencies(cascade_import cascade_sbml)
endif()
