# The first program, build/release/cascade-first. `./cascade` builds it in a fresh clone, because it
# takes little more than half the time of the whole program, and it can draw the first pictures. It
# leaves out the files that cmake/later.txt lists. Its object files are also parts of the whole
# program.
#
# Each function that it calls but leaves out is replaced by one that has the launcher build the whole
# program, which then runs the same command (app/left_out.cpp). cmake/left_out.sh writes these
# functions. So nothing else needs to know what the first program can do.

get_property(first_objects GLOBAL PROPERTY CASCADE_FIRST_OBJECTS)
list(FILTER first_objects EXCLUDE REGEX "^cascade_llvm_parts")
list(TRANSFORM first_objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
get_property(first_packages GLOBAL PROPERTY CASCADE_FIRST_PACKAGES)

set(left_out ${PROJECT_BINARY_DIR}/left_out.cpp)
add_custom_command(OUTPUT ${left_out}
  COMMAND sh ${PROJECT_SOURCE_DIR}/cmake/left_out.sh ${left_out} ${CMAKE_NM} "${first_objects}"
  DEPENDS "${first_objects}" ${PROJECT_SOURCE_DIR}/cmake/left_out.sh
  COMMAND_EXPAND_LISTS VERBATIM)

if(NOT CASCADE_TESTS)
  set(not_in_all EXCLUDE_FROM_ALL)
endif()
add_executable(cascade_first ${not_in_all} ${left_out} ${first_objects})
target_link_libraries(cascade_first PRIVATE cascade_options ${first_packages})
set_target_properties(cascade_first PROPERTIES OUTPUT_NAME cascade-first LINKER_LANGUAGE CXX BUILD_RPATH "$ORIGIN"
  RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
cascade_objects(cascade_first only FALSE ${PROJECT_SOURCE_DIR}/app/left_out.cpp)
if(TARGET cascade_llvm)
  add_dependencies(cascade_first cascade_llvm)
endif()
