#!/usr/bin/env bash
# GSL reads half of a symmetric matrix from a MatrixMarket file.
#
# Expected. The first line of a MatrixMarket file names the symmetry. "symmetric" and "skew-symmetric" files store the
# lower triangle only, and a reader adds the other half, as SciPy does, or refuses the file.
#
# What happens. gsl_spmatrix_fscanf returns the lower triangle as the whole matrix, with success. The Laplacian of a
# row of cells, -2 on the diagonal and 1 beside it, loses the ones above the diagonal: its products are wrong, and all
# its eigenvalues are -2. A skew-symmetric matrix, such as that of a first derivative, loses its upper half as well.
# Nothing warns.
#
# Workaround: write "general" files, or add the transposed matrix without its diagonal.
#
# Seen with libgsl-dev 2.7.1 of Debian 12.
set -eu
for p in libgsl-dev=2.7.1 gcc=12.2.0; do
  name=${p%%=*}
  if ! dpkg-query -W -f '${Version}' "$name" 2>/dev/null | grep -q .; then
    apt-get update -qq >/dev/null 2>&1 || true
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$name" >/dev/null 2>&1 ||
      { echo "could not install $name (Debian 12, as root)"; exit 2; }
  fi
  version=$(dpkg-query -W -f '${Version}' "$name" 2>/dev/null || true)
  case "${version#*:}" in
    "${p#*=}"[-+~]*) echo "$name $version" ;;
    *) echo "this was seen with $name ${p#*=}; here it is '${version:-not the one of Debian}'"; exit 2 ;;
  esac
done
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
cat > with_gsl.c <<'EOF_C'
#include <gsl/gsl_errno.h>
#include <gsl/gsl_spblas.h>
#include <gsl/gsl_spmatrix.h>
int main(int count, char **names) {
  gsl_set_error_handler_off();
  FILE *file = fopen(names[count - 1], "r");
  gsl_spmatrix *a = gsl_spmatrix_fscanf(file);
  if (!a) return puts("refuses it") < 0;
  gsl_vector *x = gsl_vector_alloc(4), *y = gsl_vector_alloc(4);
  for (int i = 0; i < 4; ++i) gsl_vector_set(x, i, i + 1);
  gsl_spblas_dgemv(CblasNoTrans, 1, a, x, 0, y);
  for (int i = 0; i < 4; ++i) printf("%g%s", gsl_vector_get(y, i), i < 3 ? " " : "\n");
}
EOF_C
gcc with_gsl.c -lgsl -lgslcblas -lm -o with_gsl
write() { # symmetry, entries
  local symmetry=$1
  shift
  printf '%%%%MatrixMarket matrix coordinate real %s\n4 4 %d\n' "$symmetry" $#
  printf '%s\n' "$@"
}
write general '1 1 -2' '2 2 -2' '3 3 -2' '4 4 -2' '2 1 1' '3 2 1' '4 3 1' '1 2 1' '2 3 1' '3 4 1' > general.mtx
write symmetric '1 1 -2' '2 2 -2' '3 3 -2' '4 4 -2' '2 1 1' '3 2 1' '4 3 1' > symmetric.mtx
write skew-symmetric '2 1 1' '3 2 1' '4 3 1' > skew-symmetric.mtx
for name in general symmetric skew-symmetric; do
  echo "$name matrix times 1 2 3 4: $(./with_gsl $name.mtx)"
done | tee seen
cat > expected <<'EOF_TXT'
general matrix times 1 2 3 4: 0 0 0 -5
symmetric matrix times 1 2 3 4: -2 -3 -4 -5
skew-symmetric matrix times 1 2 3 4: 0 1 2 3
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
