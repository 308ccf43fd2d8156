# What tests of ranks share: the test is skipped where ranks cannot start, and `launch` begins the command that starts
# them. A test sources this file after program_runs.bash.

skip() { echo "$about: $*"; exit 77; }
[ -e "$BUILD/libcascade_openmpi.so" ] || skip "this build has no MPI"
command -v mpiexec >/dev/null || skip "mpiexec is not installed"
# Root may start ranks only if both variables are set.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
launch=(mpiexec --oversubscribe --bind-to none)
