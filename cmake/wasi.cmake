# The toolchain for WebAssembly: clang 19 with Debian's C and C++ libraries for WASI.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-19)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_C_COMPILER clang-19)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_FLAGS_RELEASE_INIT "-O2")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
