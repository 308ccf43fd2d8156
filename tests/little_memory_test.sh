#!/bin/bash
# With any amount of memory and any output, a run succeeds or reports that memory is exhausted. It is saved first.
set -u
failed=0
[ -z "${SANITIZE-}" ] || exit 77  # Sanitizers reserve more memory than the limits here.

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

cat >cells.cascade <<'END'
domain { surface: sphere; cells: 500 }
stage s: scales { founders: 200; r: 0.05; duration: 1; interval: 2 }
END
cat >body.cascade <<'END'
domain { grid: 32, 32, 32; boundary: noflux }
stage s: turing_spots { iterations: 20; interval: 10 }
picture { body: a - 3 }
END
# With the kernels of each script found on disk: compiling them takes memory before anything is there to be saved.
outputs=('torus -o o.glb --bake 512' 'torus -o o.gif --turntable 2' 'cells -o o.png' 'cells -o o.glb --merge'
    'body -o o.png' 'body -o o.glb' 'body --volume o.vti')
for name in cells body; do "$CASCADE" run -q $name.cascade -o o.png || { echo "little_memory: $name"; failed=1; }; done
for output in "${outputs[@]}"; do
    read -r name options <<<"$output"
    for megabytes in 130 240; do
        rm -rf saved
        (ulimit -v $((megabytes * 1024)) && ulimit -c 0 &&
            exec "$CASCADE" run -q $name.cascade --save saved $options) >out 2>&1
        status=$?
        { [ $status = 0 ] || { [ $status = 3 ] && grep -q "there is not enough memory" out; }; } && [ -e saved/run.json ] ||
            { echo "little_memory: $output, $megabytes MB: status $status, $(head -c 300 out)"; failed=1; }
    done
done
# OpenVDB's libraries are loaded before the first step, or refused there.
for megabytes in 100 105 120 160; do
    (ulimit -v $((megabytes * 1024)) && ulimit -c 0 &&
        exec timeout 100 "$CASCADE" run -q body.cascade --volume o.vdb) >out 2>&1
    status=$?
    [ $status = 3 ] && grep -qE "there is not enough memory|this build has no OpenVDB" out ||
        { echo "little_memory: o.vdb, $megabytes MB: status $status, $(head -c 300 out)"; failed=1; }
done
exit $failed
