# Builds all of Cascade as one WebAssembly module, engine.wasm, for a browser's tab. It consists of
# the rooms that a session needs. Files that need threads, a file system or a native library are
# left out, and files of tab/substitutes replace them.
#
#     cmake -S . -B build/tab -DCMAKE_TOOLCHAIN_FILE=cmake/wasi.cmake && cmake --build build/tab

# Libraries that consist only of headers. No other libraries are taken from the folder of this
# machine's programs.
set(native_headers ${PROJECT_BINARY_DIR}/native_headers)
file(MAKE_DIRECTORY ${native_headers})
foreach(name fmt tl nlohmann eigen3 fftw3.h)
  if(NOT EXISTS /usr/include/${name})
    message(FATAL_ERROR "/usr/include/${name} is missing")
  endif()
  file(CREATE_LINK /usr/include/${name} ${native_headers}/${name} SYMBOLIC)
endforeach()

list(APPEND CASCADE_WITHOUT
  core/cache_sizes core/descriptor core/file core/floating_point core/granted_files core/growing_file
  core/kept_files core/late_library core/link_target core/open_below core/own_folder core/parallel core/shared_files
  core/plane_memory core/read_file core/temporary_file core/transform_planner
  device/device.* device/no_opencl device/opencl_.* device/plane_kernels device/probe
  ir/tiered_backend
  atlas/flatten atlas/join_charts atlas/unwrap
  mesh/coarse_copy mesh/collapse_edges mesh/flat_triangles mesh/gltf_.* mesh/half_edges mesh/isotropic_remesh
  mesh/simplify mesh/subdivide
  surface/mutual_tessellation surface/remove_points surface/retile
  surface/retiled_attribute
  picture/deflate picture/png_reader picture/read_grey_picture picture/read_png picture/drawing_pdf picture/exr
  picture/hdf5 picture/hdf5_driver picture/hdf5_module picture/openvdb_module picture/vdb picture/write_drawing
  export/levels render/ray_caster
  run/domain/free_memory run/domain/reshape_model run/domain/deadline
  run/pictures/frame_folder run/pictures/frames run/pictures/grid_files
  run/pictures/model_files run/pictures/plain_model run/pictures/model_maps run/pictures/growing_model run/pictures/nested_tiling run/pictures/map_size run/pictures/series
  run/session/session run/session/session_model
  run/commands/.* run/emit_c/.*
  view/admission view/carried view/connection view/loaded_models view/local_server view/outbox view/page_requests view/page_server
  view/standalone_page)

include(cmake/rooms.cmake)
target_include_directories(cascade_options SYSTEM INTERFACE ${native_headers} ${native_headers}/eigen3)
target_compile_options(cascade_options INTERFACE -msimd128 -fno-exceptions -fno-rtti)

cascade_room(core)
target_compile_definitions(cascade_core PRIVATE CASCADE_VERSION="${PROJECT_VERSION}")
cascade_room(ir)
include(cmake/no_jit.cmake)
foreach(room lang wasm solvers device picture measure mesh surface atlas tissue render export run view)
  cascade_room(${room})
endforeach()
include(lang/systems/embed.cmake)
foreach(room solvers measure)
  target_compile_definitions(cascade_${room} PRIVATE
    CASCADE_FFTW_LIBRARY="fftw3" CASCADE_FFTW_FLOAT_LIBRARY="fftw3f")
endforeach()

file(GLOB tab_sources CONFIGURE_DEPENDS tab/*.cpp tab/substitutes/*.cpp)
add_executable(engine ${tab_sources})
target_link_libraries(engine PRIVATE cascade_view cascade_wasm cascade_device)
target_link_options(engine PRIVATE -mexec-model=reactor -Wl,--export-table,--growable-table
  -Wl,-z,stack-size=4194304 -Wl,--strip-all)
set_target_properties(engine PROPERTIES SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
