# Reads package/late.txt. The functions below register what is loaded late, and stop if the table has
# no row for it.

set(late_table ${PROJECT_SOURCE_DIR}/package/late.txt)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${late_table})

# cascade_late_field(KIND NAME RESULT): the field of the row "KIND NAME".
function(cascade_late_field kind name result)
  file(STRINGS ${late_table} row REGEX "^${kind} +${name} ")
  if(NOT row)
    message(FATAL_ERROR "package/late.txt has no row '${kind} ${name}'")
  endif()
  string(REGEX REPLACE "^[a-z]+ +[^ ]+ +([A-Z][a-z]+) .*" "\\1" field "${row}")
  set(${result} ${field} PARENT_SCOPE)
endfunction()

# cascade_load_late(TARGET MACRO FILE): makes the target load the shared library FILE when it first
# needs it (core/late_library.h). Defines MACRO as the library's name, such as libembree3.so.3.
function(cascade_load_late target macro file)
  file(REAL_PATH ${file} real)
  get_filename_component(name ${real} NAME)
  string(REGEX REPLACE "(\\.so\\.[0-9]+).*" "\\1" name ${name})
  target_compile_definitions(${target} PRIVATE ${macro}="${name}")
  cascade_late_field(library ${macro} field)
  set_property(GLOBAL APPEND PROPERTY CASCADE_LATE_FILES ${field} ${real})
endfunction()

# cascade_install_module(TARGET): installs a module that the program and the library load by dlopen().
function(cascade_install_module target)
  cascade_late_field(module ${target} field)
  set_property(GLOBAL APPEND PROPERTY CASCADE_LATE_MODULES ${field} $<TARGET_FILE_NAME:${target}>)
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/cascade COMPONENT program)
endfunction()
