# A room is a folder of the source tree. Its .cpp files make the static library `cascade_NAME`.

add_library(cascade_options INTERFACE)
target_include_directories(cascade_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(cascade_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wno-sign-conversion
  -ffp-contract=off)  # The spec fixes every rounding; a fused multiply-add would drop one.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # g++ 12 and 13 warn of an overlap in std::string's own operator+, which does not exist (GCC bug
  # 105651).
  target_compile_options(cascade_options INTERFACE -Wno-restrict)
  if(CASCADE_UNITS)
    # Two kinds of warnings are false alarms: about anonymous namespaces in files that another file
    # includes, and about std::optional without -O3.
    target_compile_options(cascade_options INTERFACE -Wno-subobject-linkage -Wno-maybe-uninitialized)
  endif()
endif()
if(CASCADE_WERROR)
  target_compile_options(cascade_options INTERFACE -Werror)
endif()
if(CASCADE_SANITIZE)
  target_compile_options(cascade_options INTERFACE -fsanitize=${CASCADE_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(cascade_options INTERFACE -fsanitize=${CASCADE_SANITIZE})
endif()

include(cmake/units.cmake)

# The table of rooms, and of the rooms that each may include. CMake runs again when the table
# changes.
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND
  PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/rooms.txt)
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/rooms.txt room_table REGEX "^[a-z]")

# Sets `result` to the outer rooms that `name` and the rooms inside it may include, except `name`
# itself.
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

# cascade_room(NAME PACKAGES…): makes a library of the folder NAME and its subfolders. Leaves out
# files that match the list CASCADE_WITHOUT (regular expressions of paths without ending). Does not
# link rooms that are not built.
function(cascade_room name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/*.cpp)
  list(JOIN CASCADE_WITHOUT "|" without)
  list(FILTER sources EXCLUDE REGEX "^${PROJECT_SOURCE_DIR}/(${without})\\.cpp$")
  add_library(cascade_${name} STATIC)
  add_library(cascade_${name}_packages INTERFACE)
  target_link_libraries(cascade_${name}_packages INTERFACE ${ARGN})
  cascade_rooms_below(${name} rooms)
  foreach(room IN LISTS rooms)
    if(TARGET cascade_${room})
      target_link_libraries(cascade_${name} PUBLIC cascade_${room})
      target_link_libraries(cascade_${name}_packages INTERFACE $<TARGET_NAME_IF_EXISTS:cascade_${room}_packages>)
    endif()
  endforeach()
  target_link_libraries(cascade_${name} PUBLIC cascade_options ${ARGN})
  if(NOT "${PROJECT_SOURCE_DIR}/${name}/" MATCHES "${later_all}")
    set_property(GLOBAL APPEND PROPERTY CASCADE_FIRST_PACKAGES ${ARGN})
  endif()
  cascade_compile(cascade_${name} ${sources})
endfunction()
