# The target cascade_engine builds engine.wasm, which is put into the pages that `cascade export`
# writes. It is a separate build by another compiler (tab/engine.cmake).
set(engine_build ${PROJECT_BINARY_DIR}/tab)
if(CASCADE_TESTS AND CASCADE_UNITS AND NOT CASCADE_SANITIZE)
  set(engine_belongs ALL)
endif()
add_custom_target(cascade_engine ${engine_belongs}
  COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${engine_build} -G ${CMAKE_GENERATOR}
    -DCMAKE_TOOLCHAIN_FILE=${PROJECT_SOURCE_DIR}/cmake/wasi.cmake -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
  COMMAND ${CMAKE_COMMAND} --build ${engine_build}
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${engine_build}/engine.wasm ${PROJECT_BINARY_DIR}
  VERBATIM)
