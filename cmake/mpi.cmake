# Builds the module that uses MPI (ranks/messenger.h), if Open MPI or MPICH is installed. Everything
# else works without the module.

find_package(MPI QUIET COMPONENTS C)
if(MPI_C_FOUND)
  find_file(mpi_header mpi.h PATHS ${MPI_C_INCLUDE_DIRS} NO_DEFAULT_PATH NO_CACHE)
  file(STRINGS ${mpi_header} of_open_mpi REGEX "define OPEN_MPI ")
  if(of_open_mpi)
    set(mpi_name "Open MPI")
  else()
    set(mpi_name "MPICH")
  endif()
  add_library(cascade_mpi MODULE ${PROJECT_SOURCE_DIR}/ranks/mpi_module.cpp)
  # The C++ functions of old MPI headers are not used.
  target_compile_definitions(cascade_mpi PRIVATE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_include_directories(cascade_mpi SYSTEM PRIVATE ${MPI_C_INCLUDE_DIRS})
  target_link_libraries(cascade_mpi PRIVATE cascade_options cascade_core ${MPI_C_LIBRARIES})
  target_link_options(cascade_mpi PRIVATE LINKER:--exclude-libs,ALL)
  set_target_properties(cascade_mpi PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_compile_definitions(cascade_ranks PRIVATE
    CASCADE_MPI_MODULE="libcascade_mpi.so" CASCADE_MPI_NAME="${mpi_name}")
  add_dependencies(cascade_ranks cascade_mpi)
endif()
