# Writes the manual pages and the completions of bash, zsh and fish from the tables of --help, into
# the folder `manual` of the build tree.

add_executable(cascade_manual ${PROJECT_SOURCE_DIR}/app/write_manual.cpp)
target_link_libraries(cascade_manual PRIVATE cascade_app)
# In this folder it finds the examples, whose names are completed.
set_target_properties(cascade_manual PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})

set(manual_folder ${PROJECT_BINARY_DIR}/manual)
file(GLOB_RECURSE example_scripts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/*.cascade)
add_custom_command(
  OUTPUT ${manual_folder}/written
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${manual_folder}
  COMMAND cascade_manual ${manual_folder}
  COMMAND ${CMAKE_COMMAND} -E touch ${manual_folder}/written
  DEPENDS cascade_manual ${example_scripts}
  VERBATIM)
add_custom_target(cascade_manual_pages ALL DEPENDS ${manual_folder}/written)
