# The program `cascade`: app/ on top of the rooms.

find_path(LIBEDIT_INCLUDE_DIR histedit.h REQUIRED)
find_library(LIBEDIT_LIBRARY edit REQUIRED)

# app/ without main() is a library, so that its parts can be tested.
list(APPEND CASCADE_WITHOUT app/main)
cascade_room(app CLI11::CLI11 ${LIBEDIT_LIBRARY})
target_include_directories(cascade_app SYSTEM PRIVATE ${LIBEDIT_INCLUDE_DIR})

add_executable(cascade_program app/main.cpp)
target_link_libraries(cascade_program PRIVATE cascade_app)
set_target_properties(cascade_program PROPERTIES
  OUTPUT_NAME cascade
  RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
