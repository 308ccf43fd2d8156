# The program `cascade`: app/ on top of the rooms.

find_path(LIBEDIT_INCLUDE_DIR histedit.h REQUIRED)
find_library(LIBEDIT_LIBRARY edit REQUIRED)

cascade_room(app CLI11::CLI11 ${LIBEDIT_LIBRARY})
target_include_directories(cascade_app SYSTEM PRIVATE ${LIBEDIT_INCLUDE_DIR})

# app/ without main() is a library, too, so that its parts can be tested.
get_target_property(app_sources cascade_app SOURCES)
list(REMOVE_ITEM app_sources ${PROJECT_SOURCE_DIR}/app/main.cpp)
set_property(TARGET cascade_app PROPERTY SOURCES ${app_sources})

add_executable(cascade_program app/main.cpp)
target_link_libraries(cascade_program PRIVATE cascade_app)
set_target_properties(cascade_program PROPERTIES
  OUTPUT_NAME cascade
  RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
