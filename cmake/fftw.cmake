# FFTW 3 in double and in single precision. Debian's package has no CMake files.

find_path(FFTW_INCLUDE_DIR fftw3.h REQUIRED)
find_library(FFTW_LIBRARY fftw3 REQUIRED)
find_library(FFTW_FLOAT_LIBRARY fftw3f REQUIRED)

# Links FFTW to a room; only the room's .cpp files may include its header.
function(cascade_link_fftw target)
  target_include_directories(${target} SYSTEM PRIVATE ${FFTW_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE ${FFTW_LIBRARY} ${FFTW_FLOAT_LIBRARY})
endfunction()
