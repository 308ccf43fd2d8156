# CPack runs this file when the three parts of the packages are below its temporary folder. It adds
# the files that Debian requires, and computes the fields Depends, Recommends and Suggests.

cmake_policy(VERSION 3.25)  # CPack itself sets none.
include(${CPACK_CASCADE_VALUES})
set(names ${CPACK_DEBIAN_PROGRAM_PACKAGE_NAME} ${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME} ${CPACK_DEBIAN_PYTHON_PACKAGE_NAME})
set(program ${CPACK_TEMPORARY_DIRECTORY}/program/usr)
set(library ${CPACK_TEMPORARY_DIRECTORY}/library/usr)
set(python ${CPACK_TEMPORARY_DIRECTORY}/python/usr)

if(NOT EXISTS ${program}/share/cascade/engine.wasm)
  message(FATAL_ERROR "The engine of exported pages is missing: build the target cascade_engine first.")
endif()

# run(COMMAND…): runs a command, or stops with its message. Sets `output`.
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE error RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed: ${error}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# The date of the release.
set(seconds $ENV{SOURCE_DATE_EPOCH})
if(NOT seconds)
  string(TIMESTAMP seconds %s UTC)
endif()
run(env LC_ALL=C date -u -R -d @${seconds})
string(STRIP "${output}" date)

# Documents of each package.
foreach(part IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${part} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(documents ${CPACK_TEMPORARY_DIRECTORY}/${part}/usr/share/doc/${name})
  file(READ ${project_folder}/LICENSE license)
  string(REGEX REPLACE "^MIT License\n\nCopyright[^\n]*\n\n" "" license "${license}")
  string(STRIP "${license}" license)
  string(REPLACE "\n\n" "\n.\n" license "${license}")
  string(REPLACE "\n" "\n " license "${license}")
  file(WRITE ${documents}/copyright "\
Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: Cascade
Upstream-Contact: ${CPACK_PACKAGE_CONTACT}

Files: *
Copyright: 2026 the Cascade authors
License: Expat
 ${license}
")
  file(WRITE ${documents}/changelog.Debian "\
cascade-patterns (${package_version}) unstable; urgency=medium

  * Cascade ${CPACK_PACKAGE_VERSION}: changelog.gz lists what users notice.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  file(COPY_FILE ${project_folder}/CHANGELOG.md ${documents}/changelog)
  run(gzip -9nf ${documents}/changelog ${documents}/changelog.Debian)
endforeach()
# Debian names the folder of documents as the package.
file(COPY ${program}/share/doc/cascade/ DESTINATION ${program}/share/doc/${CPACK_DEBIAN_PROGRAM_PACKAGE_NAME})
file(REMOVE_RECURSE ${program}/share/doc/cascade)
file(GLOB pages ${program}/share/man/man1/*.1)
run(gzip -9nf ${pages})
file(CREATE_LINK ../../cascade/examples ${program}/share/doc/${CPACK_DEBIAN_PROGRAM_PACKAGE_NAME}/examples SYMBOLIC)

# The libraries that ELF files need: dpkg-shlibdeps knows the package of each.
set(work ${CPACK_TEMPORARY_DIRECTORY}/shlibdeps)
file(WRITE ${work}/debian/control "Source: cascade-patterns\n\nPackage: cascade-patterns\nArchitecture: any\n")
# needs(FIELD FILE… FIELD FILE…): sets the variables Depends, Recommends and Suggests.
function(needs)
  set(words)
  foreach(word IN LISTS ARGN)
    if(word MATCHES "^/")
      list(APPEND words -e${word})
    else()
      list(APPEND words -d${word})
    endif()
  endforeach()
  execute_process(COMMAND dpkg-shlibdeps -O --ignore-missing-info -l${library}/lib ${words}
    WORKING_DIRECTORY ${work} OUTPUT_VARIABLE output ERROR_VARIABLE error RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "dpkg-shlibdeps failed: ${error}")
  endif()
  foreach(field Depends Recommends Suggests)
    set(packages)
    if(output MATCHES "shlibs:${field}=([^\n]*)")
      string(REPLACE ", " ";" packages "${CMAKE_MATCH_1}")
    endif()
    set(${field} "${packages}" PARENT_SCOPE)
  endforeach()
endfunction()

# write_fields(PART): gives CPack the fields.
macro(write_fields part)
  foreach(field Depends Recommends Suggests)
    list(REMOVE_DUPLICATES ${field})
    list(JOIN ${field} ", " packages)
    string(TOUPPER ${field} upper)
    set(CPACK_DEBIAN_${part}_PACKAGE_${upper} "${packages}")
  endforeach()
endmacro()

set(late)
foreach(word IN LISTS late_modules)
  if(word MATCHES "^lib")
    list(APPEND late ${program}/lib/cascade/${word})
  else()
    list(APPEND late ${word})
  endif()
endforeach()
needs(Depends ${program}/bin/cascade ${late})
foreach(word IN LISTS late_files)
  if(word MATCHES "^/")
    run(dpkg-query -S ${word})
    string(REGEX REPLACE ":.*" "" package "${output}")
    list(APPEND ${field} ${package})
  else()
    set(field ${word})
  endif()
endforeach()
file(STRINGS ${late_table} rows REGEX "^package ")
foreach(row IN LISTS rows)
  string(REGEX MATCH "^package +([^ ]+) +([A-Z][a-z]+)" ignored "${row}")
  list(APPEND ${CMAKE_MATCH_2} ${CMAKE_MATCH_1})
endforeach()
write_fields(PROGRAM)

# The library loads the same modules and libraries, which the package of the program brings.
file(GLOB libraries ${library}/lib/libcascade.so.*.*)
needs(Depends ${libraries})
list(APPEND Depends "${CPACK_DEBIAN_PROGRAM_PACKAGE_NAME} (= ${package_version})")
write_fields(LIBRARY)

if("python" IN_LIST CPACK_COMPONENTS_ALL)
  file(GLOB modules ${python}/lib/python3/dist-packages/cascade/_core*.so)
  needs(Depends ${modules})
  math(EXPR next_minor "${python_minor} + 1")
  list(APPEND Depends "${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME} (= ${package_version})"
    "python3 (>= ${python_major}.${python_minor})" "python3 (<< ${python_major}.${next_minor})" python3-numpy)
  write_fields(PYTHON)
endif()
