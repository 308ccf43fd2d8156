# A room is a folder of the source tree and a static library `cascade_NAME` of all its .cpp files.

add_library(cascade_options INTERFACE)
target_include_directories(cascade_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(cascade_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wno-sign-conversion
  -ffp-contract=off)  # The spec fixes every rounding; a fused multiply-add would drop one.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # g++ 12 and 13 see an overlap in std::string's own operator+ (GCC bug 105651).
  target_compile_options(cascade_options INTERFACE -Wno-restrict)
endif()
if(CASCADE_WERROR)
  target_compile_options(cascade_options INTERFACE -Werror)
endif()
if(CASCADE_SANITIZE)
  target_compile_options(cascade_options INTERFACE -fsanitize=${CASCADE_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(cascade_options INTERFACE -fsanitize=${CASCADE_SANITIZE})
endif()

function(cascade_room name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${name}/*.cpp)
  add_library(cascade_${name} STATIC ${sources})
  target_link_libraries(cascade_${name} PUBLIC cascade_options ${ARGN})
endfunction()
