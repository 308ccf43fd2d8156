# Builds the program `cascade`: app/ and the rooms below it.

find_path(LIBEDIT_INCLUDE_DIR histedit.h REQUIRED)
find_library(LIBEDIT_LIBRARY edit REQUIRED)

# app/ without its main functions is a library, so that its parts can be tested.
list(APPEND CASCADE_WITHOUT app/main app/left_out app/write_manual)
cascade_room(app CLI11::CLI11 ${LIBEDIT_LIBRARY})
target_include_directories(cascade_app SYSTEM PRIVATE ${LIBEDIT_INCLUDE_DIR})

add_executable(cascade_program)
target_link_libraries(cascade_program PRIVATE cascade_app)
cascade_compile(cascade_program ${PROJECT_SOURCE_DIR}/app/main.cpp)
set_target_properties(cascade_program PROPERTIES
  OUTPUT_NAME cascade
  RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})

# `cascade examples` finds the examples beside the program (core/shared_files.h).
file(RELATIVE_PATH examples_from_build ${PROJECT_BINARY_DIR} ${PROJECT_SOURCE_DIR}/examples)
file(CREATE_LINK ${examples_from_build} ${PROJECT_BINARY_DIR}/examples SYMBOLIC)
