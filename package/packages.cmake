# Debian packages by CPack, in three parts: the program, the library with its headers, the module of
# Python.
#
#     cmake --build build/release --target cascade_installed && (cd build/release && cpack)
#
# writes three files .deb. package/release.sh does this and more.

# Everything that is installed.
add_custom_target(cascade_installed)
foreach(target cascade_program cascade_llvm cascade_openvdb cascade_hdf5 cascade_sbml cascade_library cascade_python
    cascade_manual_pages cascade_engine)
  if(TARGET ${target})
    add_dependencies(cascade_installed ${target})
  endif()
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cascade-patterns)
set(CPACK_PACKAGE_VENDOR "The Cascade authors")
# No mail reaches the domain .example, which is reserved (RFC 2606). Debian requires an address.
set(CPACK_PACKAGE_CONTACT "The Cascade authors <authors@cascade.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program library)
if(TARGET cascade_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# The names, sections and descriptions. Debian has no packages of these names.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME cascade-patterns)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "language and compiler for patterns of reaction and diffusion
A page of text with equations, stages and a picture becomes a pattern:
leopard, lionfish, honeycomb, coral. Cascade compiles the equations to vector
code and runs them on planes, in volumes, and on surfaces of 3-D models.
.
Besides the program the package contains its specification, a tutorial,
example scripts and completions for bash, zsh and fish.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libcascade-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "patterns of reaction and diffusion in C and C++ programs
The library runs scripts of the language Cascade inside other programs: it
steps patterns, changes parameters, and gives access to their values without
copies.
.
The package contains the shared library, its headers for C and C++, and files
for CMake and pkg-config.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-cascade)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "patterns of reaction and diffusion in Python
The module runs scripts of the language Cascade from Python and from
notebooks. Species are NumPy arrays that share memory with the pattern.
.
Parameters can be varied in sweeps, and pictures appear in notebooks.")

# What the packages need is computed from the installed files and package/late.txt.
get_property(late_files GLOBAL PROPERTY CASCADE_LATE_FILES)
get_property(late_modules GLOBAL PROPERTY CASCADE_LATE_MODULES)
set(package_values ${PROJECT_BINARY_DIR}/package_values.cmake)
file(GENERATE OUTPUT ${package_values} CONTENT "\
set(late_files \"${late_files}\")
set(late_modules \"${late_modules}\")
set(late_table \"${late_table}\")
set(project_folder \"${PROJECT_SOURCE_DIR}\")
set(package_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(python_major ${Python3_VERSION_MAJOR})
set(python_minor ${Python3_VERSION_MINOR})
")
set(CPACK_CASCADE_VALUES ${package_values})
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/package/debian_files.cmake)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/package/triggers)
include(CPack)
