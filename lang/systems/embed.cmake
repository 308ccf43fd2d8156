# Writes the systems, shapes and functions of cells of the library, which are Cascade texts, into
# one C++ file as raw strings. Runs when CMake configures, which happens whenever a text changes or
# is added.
file(GLOB built_in_systems CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lang/systems/*.cascade)
file(GLOB built_in_cells CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lang/cells/*.cascade)
file(GLOB built_in_shapes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lang/shapes/*.cascade)
list(SORT built_in_systems)
list(SORT built_in_cells)
list(SORT built_in_shapes)
set(cell_functions_path ${PROJECT_SOURCE_DIR}/lang/library/cell_functions.cascade)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND
  PROPERTY CMAKE_CONFIGURE_DEPENDS ${built_in_systems} ${built_in_cells} ${built_in_shapes}
    ${cell_functions_path})
file(READ ${cell_functions_path} cell_functions)

foreach(kind systems cells shapes)
  set(built_in_${kind}_entries "")
  foreach(path IN LISTS built_in_${kind})
    get_filename_component(name ${path} NAME)
    file(READ ${path} text)
    string(APPEND built_in_${kind}_entries "    {\"${name}\", R\"cascade(${text})cascade\"},\n")
  endforeach()
endforeach()

set(built_in_source ${PROJECT_BINARY_DIR}/lang/built_in_systems.cpp)
file(CONFIGURE OUTPUT ${built_in_source} @ONLY CONTENT [[
// Made by lang/systems/embed.cmake from the texts in lang/systems/, lang/cells/, lang/shapes/ and
// lang/library/.
#include "lang/library/library.h"

#include <array>

namespace cascade {

namespace {

constexpr auto texts = std::to_array<LibraryText>({
@built_in_systems_entries@});

constexpr auto cells = std::to_array<LibraryText>({
@built_in_cells_entries@});

constexpr auto shapes = std::to_array<LibraryText>({
@built_in_shapes_entries@});

constexpr LibraryText functions{"cell_functions.cascade", R"cascade(@cell_functions@)cascade"};

}  // namespace

std::span<const LibraryText> library_texts() { return texts; }

std::span<const LibraryText> library_cells() { return cells; }

std::span<const LibraryText> library_shapes() { return shapes; }

const LibraryText& cell_functions() { return functions; }

}  // namespace cascade
]])
if(TARGET cascade_lang_first)
  set_source_files_properties(${built_in_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(cascade_lang_first PRIVATE ${built_in_source})
else()
  target_sources(cascade_lang PRIVATE ${built_in_source})
endif()
