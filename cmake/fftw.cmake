# Finds FFTW 3 in double and in single precision. Debian's package has no CMake files.

find_path(FFTW_INCLUDE_DIR fftw3.h REQUIRED)
find_library(FFTW_LIBRARY fftw3 REQUIRED)
find_library(FFTW_FLOAT_LIBRARY fftw3f REQUIRED)

# Makes a room load FFTW when it first needs it.
function(cascade_use_fftw target)
  target_include_directories(${target} SYSTEM PRIVATE ${FFTW_INCLUDE_DIR})
  cascade_load_late(${target} CASCADE_FFTW_LIBRARY ${FFTW_LIBRARY})
  cascade_load_late(${target} CASCADE_FFTW_FLOAT_LIBRARY ${FFTW_FLOAT_LIBRARY})
endfunction()
