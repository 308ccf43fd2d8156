# Compiles several files at a time, most of them with little optimisation, and all of them with a
# precompiled header. Of the text that the compiler reads for a file, 98 % is headers and 2 % is the
# file's own (docs/building.md). So some files of a target are compiled together as one unit. Then
# their headers are read once, and their templates are compiled once. A unit is as large as a
# compiler process of less than 1 GiB allows. Names in anonymous namespaces must therefore differ
# within a room.
#
# CASCADE_UNITS=OFF compiles each file by itself, without the precompiled header. It optimises
# fully, because g++ 12 otherwise warns of std::optional. The preset `strict` builds in this way and
# so finds missing includes.

# The number of bytes of source text in a unit.
set(unit_size 130000)

# Files that are a unit by themselves, because their templates take as much memory as one compiler
# process may use. "a|b" is a unit of two files with the same templates.
set(separate_units analysis/eigenvalues analysis/linear_algebra continuation/factors continuation/modes
  "view/connection|view/local_server")

# Headers whose templates are compiled again in each unit that uses them. The files that include
# them are put into the same units, and count as if they were a quarter larger.
set(heavy_headers "nlohmann/json\\.hpp|json_fields\\.h|glb_file\\.h|mesh/gltf_")

# The headers that are precompiled. g++ needs a precompiled header for each level of optimisation.
set(common_headers <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numbers>
  <numeric> <optional> <set> <span> <string> <string_view> <unordered_map> <utility> <variant> <vector>
  <fmt/format.h> <tl/expected.hpp>)

# cascade_read_table(NAME): reads cmake/NAME.txt, a list of rooms, folders and files without ending.
# Sets NAME_all and, from lines that begin with "-", NAME_out, two regular expressions of paths.
function(cascade_read_table name)
  set(path ${PROJECT_SOURCE_DIR}/cmake/${name}.txt)
  set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(STRINGS ${path} all REGEX "^[-a-z]")
  string(REPLACE " " ";" all "${all}")
  set(out ${all})
  list(FILTER out INCLUDE REGEX "^-")
  list(TRANSFORM out REPLACE "^-" "")
  list(FILTER all EXCLUDE REGEX "^-")
  foreach(entry IN LISTS all out)
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${entry} AND NOT EXISTS ${PROJECT_SOURCE_DIR}/${entry}.cpp)
      message(FATAL_ERROR "cmake/${name}.txt names ${entry}, which does not exist")
    endif()
  endforeach()
  foreach(kind all out)
    list(JOIN ${kind} "|" joined)
    set(${name}_${kind} "^${PROJECT_SOURCE_DIR}/(${joined})[/.]" PARENT_SCOPE)
  endforeach()
endfunction()
cascade_read_table(optimised)
cascade_read_table(later)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32)
  set(later_all ".")  # The engine of pages has no first program.
  set(later_out "^$")
endif()

# cascade_divide(TABLE LISTED OTHERS FILES…): sets LISTED to the files that a table lists and OTHERS
# to the other files.
function(cascade_divide table listed others)
  set(chosen "${ARGN}")
  list(FILTER chosen INCLUDE REGEX ${${table}_all})
  list(FILTER chosen EXCLUDE REGEX ${${table}_out})
  set(rest "${ARGN}")
  if(chosen)
    list(REMOVE_ITEM rest ${chosen})
  endif()
  set(${listed} ${chosen} PARENT_SCOPE)
  set(${others} ${rest} PARENT_SCOPE)
endfunction()

# The options of code with loops over many elements, and of all other code. Compilers vectorise
# loops with square roots and selections only if errno and floating-point traps are turned off.
# Neither changes a value.
set(loop_options $<$<CONFIG:Release>:-O3> -fno-math-errno -fno-trapping-math)
set(usual_options)
if(CASCADE_UNITS)
  set(usual_options $<$<CONFIG:Release>:-O1>)
endif()

# g++ collects garbage in its memory from 128 MB on. If it begins later, it takes a tenth less time
# and still less than 1 GiB.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(cascade_options INTERFACE --param=ggc-min-heapsize=350000)
endif()

# cascade_headers(NAME OPTIONS…): makes a target whose precompiled header is shared by targets with
# the same options.
function(cascade_headers name)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cpp CONTENT "// Has the precompiled header compiled.\n")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE cascade_options)
  foreach(package fmt::fmt tl::expected)
    if(TARGET ${package})
      target_link_libraries(${name} PRIVATE ${package})
    endif()
  endforeach()
  target_compile_options(${name} PRIVATE ${ARGN})
  target_precompile_headers(${name} PRIVATE ${common_headers})
endfunction()
if(CASCADE_UNITS)
  cascade_headers(cascade_headers ${usual_options})
  cascade_headers(cascade_loop_headers ${loop_options})
endif()

# cascade_units(TARGET HEADERS FILES…): compiles the files of a target in units, with the
# precompiled header of the target HEADERS.
function(cascade_units target headers)
  if(NOT CASCADE_UNITS)
    return()
  endif()
  set(all 0)
  set(first)
  set(others)
  foreach(path IN LISTS ARGN)
    set(separate)
    foreach(unit IN LISTS separate_units)
      if(path MATCHES "^${PROJECT_SOURCE_DIR}/(${unit})\\.cpp$")
        string(MAKE_C_IDENTIFIER ${unit} separate)
      endif()
    endforeach()
    if(separate)
      set_source_files_properties(${path} PROPERTIES UNITY_GROUP ${separate})
      continue()
    endif()
    file(SIZE ${path} size)
    file(STRINGS ${path} heavy REGEX "#include .*(${heavy_headers})" LIMIT_COUNT 1)
    if(heavy)
      list(APPEND first ${path})
      math(EXPR size "${size} * 5 / 4")
    else()
      list(APPEND others ${path})
    endif()
    set(size_of_${path} ${size})
    math(EXPR all "${all} + ${size}")
  endforeach()
  math(EXPR count "(${all} + ${unit_size} - 1) / ${unit_size}")
  set(before 0)
  foreach(path IN LISTS first others)
    math(EXPR unit "${before} * ${count} / ${all}")
    set_source_files_properties(${path} PROPERTIES UNITY_GROUP ${unit})
    math(EXPR before "${before} + ${size_of_${path}}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_precompile_headers(${target} REUSE_FROM ${headers})
endfunction()

# cascade_objects(TARGET PART LOOPS FILES…): compiles files of a target as the object library
# TARGET_PART, with the options for loops if LOOPS is true. Does not link the rooms that the target
# links, because they would be built first.
function(cascade_objects target part loops)
  if(NOT ARGN)
    return()
  endif()
  set(objects ${target}_${part})
  add_library(${objects} OBJECT ${ARGN})
  target_link_libraries(${objects} PRIVATE cascade_options $<TARGET_NAME_IF_EXISTS:${target}_packages>)
  foreach(property COMPILE_DEFINITIONS INCLUDE_DIRECTORIES)
    set_property(TARGET ${objects} APPEND PROPERTY ${property} $<TARGET_PROPERTY:${target},${property}>)
  endforeach()
  if(loops)
    target_compile_options(${objects} PRIVATE ${loop_options})
    cascade_units(${objects} cascade_loop_headers ${ARGN})
  else()
    target_compile_options(${objects} PRIVATE ${usual_options})
    cascade_units(${objects} cascade_headers ${ARGN})
  endif()
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
endfunction()

# cascade_compile(TARGET FILES…): adds files to the library of a room, optimised as
# cmake/optimised.txt says. Files of the first program (cmake/first.cmake) and other files are
# different units.
function(cascade_compile target)
  cascade_divide(later later first ${ARGN})
  cascade_divide(optimised loops usual ${first})
  cascade_objects(${target} first_loops TRUE ${loops})
  cascade_objects(${target} first FALSE ${usual})
  foreach(part first first_loops)
    if(TARGET ${target}_${part})
      set_property(GLOBAL APPEND PROPERTY CASCADE_FIRST_OBJECTS ${target}_${part})
    endif()
  endforeach()
  cascade_divide(optimised loops usual ${later})
  cascade_objects(${target} loops TRUE ${loops})
  target_sources(${target} PRIVATE ${usual})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  target_compile_options(${target} PRIVATE ${usual_options})
  if(usual)
    cascade_units(${target} cascade_headers ${usual})
  endif()
endfunction()
