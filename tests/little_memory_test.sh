#!/bin/bash
# Whatever memory there is: a run with a picture of a model ends well, or says that there is not enough.
set -u
failed=0
[ -z "${SANITIZE-}" ] || exit 77  # Sanitizers reserve more than there is.

cat >torus.cascade <<'END'
domain { surface: torus; cells: 20000 }
stage s: turing_spots { iterations: 2 }
END
for megabytes in $(seq 100 20 280) $(seq 290 5 360); do
    (ulimit -v $((megabytes * 1024)) && ulimit -c 0 && exec "$CASCADE" run -q torus.cascade -o torus.png) >out 2>&1
    status=$?
    case $status in
        0) last=written ;;
        3) last=refused && grep -q "there is not enough memory" out ;;
        *) false ;;
    esac || { echo "little_memory: $megabytes MB: status $status, $(head -c 300 out)"; failed=1; }
done
[ "${last-}" = written ] || { echo "little_memory: the most is not enough"; failed=1; }
exit $failed
