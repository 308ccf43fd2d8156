# The files of the page, as page/build.sh makes them, become one C++ file of raw strings, so that building
# Cascade needs no node.
set(page_files index.html page.css page.js worker.js)
list(TRANSFORM page_files PREPEND ${PROJECT_SOURCE_DIR}/page/built/)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page_files})

foreach(path IN LISTS page_files)
  get_filename_component(name ${path} NAME)
  file(READ ${path} text)
  string(REPLACE "." "_" name ${name})
  set(${name} "${text}")
endforeach()

set(page_source ${PROJECT_BINARY_DIR}/view/page_files.cpp)
file(CONFIGURE OUTPUT ${page_source} @ONLY CONTENT [[
// Made by page/embed.cmake from page/built.
#include "view/page_files.h"

namespace cascade {

PageFiles page_files() {
    return {{"/", {"text/html; charset=utf-8", R"page(@index_html@)page"}},
            {"/page.css", {"text/css; charset=utf-8", R"page(@page_css@)page"}},
            {"/page.js", {"text/javascript; charset=utf-8", R"page(@page_js@)page"}}};
}

std::string_view page_worker() { return R"page(@worker_js@)page"; }

}  // namespace cascade
]])
target_sources(cascade_view PRIVATE ${page_source})
