# What `cmake --install` installs besides programs and libraries (cmake/library.cmake,
# cmake/python.cmake). Everything belongs to one of three components, which become packages
# (package/packages.cmake): program, library, python.

set(share ${CMAKE_INSTALL_DATAROOTDIR})

# Manual pages and completions (package/manual.cmake).
install(DIRECTORY ${manual_folder}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${manual_folder}/bash/cascade DESTINATION ${share}/bash-completion/completions COMPONENT program)
install(FILES ${manual_folder}/zsh/_cascade DESTINATION ${share}/zsh/vendor-completions COMPONENT program)
install(FILES ${manual_folder}/fish/cascade.fish DESTINATION ${share}/fish/vendor_completions.d COMPONENT program)

# Files that the program finds when it needs them (core/shared_files.h). The pictures of the gallery
# are not installed, because a command draws each of them again.
install(FILES ${PROJECT_BINARY_DIR}/engine.wasm DESTINATION ${share}/cascade COMPONENT program OPTIONAL)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${share}/cascade COMPONENT program
  FILES_MATCHING PATTERN *.cascade PATTERN *.c PATTERN *.cpp PATTERN CMakeLists.txt PATTERN maps/*.png
  PATTERN large EXCLUDE PATTERN models EXCLUDE)

# Documents.
set(documents ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/spec ${PROJECT_SOURCE_DIR}/docs DESTINATION ${documents} COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${documents}
  COMPONENT program)

# The desktop: a double click on a script opens `cascade view`.
install(FILES ${PROJECT_SOURCE_DIR}/package/cascade.desktop DESTINATION ${share}/applications COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/package/cascade.xml DESTINATION ${share}/mime/packages COMPONENT program)
set(icons ${share}/icons/hicolor/scalable)
install(FILES ${PROJECT_SOURCE_DIR}/package/cascade.svg DESTINATION ${icons}/apps COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/package/cascade.svg DESTINATION ${icons}/mimetypes COMPONENT program
  RENAME text-x-cascade.svg)

# For compilers that are started without CMake. Its paths are relative, so that the prefix can move.
file(RELATIVE_PATH prefix_from_pkgconfig ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(${PROJECT_SOURCE_DIR}/package/cascade.pc.in cascade.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/cascade.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
