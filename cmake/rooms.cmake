# A room is a folder of the source tree; its .cpp files make the static library `cascade_NAME`.

add_library(cascade_options INTERFACE)
target_include_directories(cascade_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(cascade_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wno-sign-conversion
  -ffp-contract=off)  # The spec fixes every rounding; a fused multiply-add would drop one.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # g++ 12 and 13 warn of an overlap in std::string's own operator+ (GCC bug 105651).
  target_compile_options(cascade_options INTERFACE -Wno-restrict)
endif()
if(CASCADE_WERROR)
  target_compile_options(cascade_options INTERFACE -Werror)
endif()
if(CASCADE_SANITIZE)
  target_compile_options(cascade_options INTERFACE -fsanitize=${CASCADE_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(cascade_options INTERFACE -fsanitize=${CASCADE_SANITIZE})
endif()

# Compilers vectorise loops with square roots and choices only without errno and floating-point traps.
set_source_files_properties(mesh/limbs.cpp solvers/flicker.cpp surface/repulsion.cpp
  PROPERTIES COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math")

# With CASCADE_UNITY several files of a target are compiled as one, so that their headers are read once: a
# full build takes a third of the time, a change of one file takes longer. Not for builds with warnings as
# errors, since files that are compiled together can cause warnings that each of them does not.
# Arguments after the target are files that another target compiles, too; they are compiled separately, so
# that the linker takes only one of the two.
function(cascade_compile_together target)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CASCADE_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# The table of rooms and of what each may include. A changed table reconfigures the build.
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND
  PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/rooms.txt)
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/rooms.txt room_table REGEX "^[a-z]")

# The outer rooms that `name` and the rooms inside it may include, without itself.
function(cascade_rooms_below name result)
  set(lines ${room_table})
  list(FILTER lines INCLUDE REGEX "^${name}[:/]")
  if(NOT lines)
    message(FATAL_ERROR "cmake/rooms.txt has no room ${name}")
  endif()
  list(TRANSFORM lines REPLACE "^[^:]*: ?" "")
  string(REPLACE " " ";" rooms "${lines}")
  list(TRANSFORM rooms REPLACE "/.*" "")
  list(REMOVE_DUPLICATES rooms)
  list(REMOVE_ITEM rooms ${name})
  set(${result} ${rooms} PARENT_SCOPE)
endfunction()

# cascade_load_late(TARGET MACRO FILE): the target loads a shared library when it first needs it
# (core/late_library.h), by the name that the macro holds, such as libembree3.so.3.
function(cascade_load_late target macro file)
  file(REAL_PATH ${file} real)
  get_filename_component(name ${real} NAME)
  string(REGEX REPLACE "(\\.so\\.[0-9]+).*" "\\1" name ${name})
  target_compile_definitions(${target} PRIVATE ${macro}="${name}")
endfunction()

# cascade_room(NAME PACKAGES…): the library of the folder NAME and its subfolders. Files in the list
# CASCADE_WITHOUT, regular expressions without their ending, are left out, as are rooms that are not built.
function(cascade_room name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/*.cpp)
  list(JOIN CASCADE_WITHOUT "|" without)
  list(FILTER sources EXCLUDE REGEX "^${PROJECT_SOURCE_DIR}/(${without})\\.cpp$")
  add_library(cascade_${name} STATIC ${sources})
  cascade_rooms_below(${name} rooms)
  foreach(room IN LISTS rooms)
    if(TARGET cascade_${room})
      target_link_libraries(cascade_${name} PUBLIC cascade_${room})
    endif()
  endforeach()
  target_link_libraries(cascade_${name} PUBLIC cascade_options ${ARGN})
  cascade_compile_together(cascade_${name})
endfunction()
