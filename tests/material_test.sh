#!/bin/bash
# Materials of the picture block: maps of planes and models are decoded and compared with the formulas, interpreter and
# native code give the same bits, and wrong combinations are refused.
set -u
rm -rf ./*
about=material
. "$SOURCE/tests/support/program_runs.bash"

# check_maps NAME ARGUMENTS…: runs a check of tests/support/maps.py if Python is installed.
check_maps() {
    command -v python3 >/dev/null || return 0
    python3 "$SOURCE/tests/support/maps.py" "$@" >out 2>err || fail "maps.py $*"
}

# A periodic pattern of waves given by formulas: every map must contain its own part.
cat > waves.cascade <<'END'
system wave {
  u: 0.5 + 0.5 * sin(2 * pi * sx) * cos(4 * pi * sy)
  w: sx < 0.5
  u' = 0
  w' = 0
}
domain { grid: 48, 32; spacing: 0.5 }
stage s: wave { iterations: 1 }
picture {
  color: rgb(u, 0.25, 1 - u)
  roughness: 0.2 + 0.6 * u
  metalness: w
  opacity: 1 - 0.5 * w
  emission: rgb(0, w, 0.5 * u)
  height: 2 * u
}
END
run 0 run waves.cascade -o waves.png -o waves.glb --bake 384 --save saved
for map in color height normal occlusion roughness metalness emission opacity; do
    says out "wrote waves_$map.png"
done
grep -q "not from 0 to 1" err && fail "a warning about good values"
check_maps waves waves saved
# Formulas are computed between cells: a circle of 32 cells has a smooth outline at 512 texels.
cat > disc.cascade <<'END'
system square { u: (sx - 0.5)^2 + (sy - 0.5)^2; u' = 0 }
domain { grid: 32, 32 }
stage s: square { iterations: 1 }
picture { color: if(u < 0.1, rgb(1, 0, 0), rgb(0, 0, 1)) }
END
run 0 run -q disc.cascade -o disc.glb --bake 512
check_maps disc disc
# A texture whose size is not a multiple of the grid's.
run 0 run -q waves.cascade -o odd.glb --bake 100
check_maps size odd 100 67

# The interpreter, native code and one thread write the same bytes.
for backend in interp jit; do
    [ $backend = jit ] && [ "${CASCADE_JIT:-1}" = 0 ] && continue
    run 0 run -q waves.cascade -o $backend.glb --bake 96 --backend $backend --threads 1
    for map in color height normal occlusion roughness metalness emission opacity; do
        cmp -s interp_$map.png ${backend}_$map.png || fail "$map.png of $backend"
    done
    cmp -s interp.glb $backend.glb || fail "the model of $backend"
done

# Only maps that the picture sets are written.
cat > plain.cascade <<'END'
stage s: gray_scott { iterations: 40 }
END
run 0 run plain.cascade -o plain.glb --bake 64
says out "wrote plain_color.png"
[ "$(ls plain_*.png)" = plain_color.png ] || fail "maps of a picture that says nothing: $(ls plain_*)"
check_maps json plain no-sampler opaque
# Maps are clamped at sides that are not periodic; holes are transparent.
cat > holes.cascade <<'END'
domain { grid: 40, 40; boundary: noflux, periodic; mask: (x - 0.5)^2 + (y - 0.5)^2 < 0.16 }
stage s: gray_scott { iterations: 40 }
END
run 0 run holes.cascade -o holes.glb --bake 64
says out "wrote holes_opacity.png"
check_maps json holes sampler MASK

# A slice of a volume.
cat > volume.cascade <<'END'
domain { grid: 32, 16, 24 }
stage s: gray_scott { iterations: 4 }
END
run 0 run -q volume.cascade -o across.glb --bake 64 --slice y=0.5
check_maps size across 64 48

# A model gets the same kinds of maps as a plane.
write_square
cat > on_model.cascade <<'END'
system wave { u: x; u' = 0 }
stage s: wave { iterations: 1 }
picture {
  color: rgb(0.5, 0.5, 0.5)
  roughness: 0.25
  metalness: u
  opacity: 1
  emission: rgb(0.5, 0, 0)
  height: 2 * sin(6 * pi * x)
}
END
run 0 run on_model.cascade --mesh square.obj --cells 2000 -o on_model.glb --bake 128
for map in color height normal occlusion roughness metalness emission opacity; do
    says out "wrote on_model_$map.png"
done
check_maps on_model on_model
run 0 mesh on_model.glb
says out "4 points, 2 triangles"
# Heights shade pictures of models, and --bump replaces them.
run 0 run -q on_model.cascade --mesh square.obj --cells 2000 -o raised.png --view 20,60
sed '/height:/d; /emission:/d' on_model.cascade > flat.cascade
run 0 run -q flat.cascade --mesh square.obj --cells 2000 -o flat.png --view 20,60
cmp -s raised.png flat.png && fail "height and emission change no picture"
# Pictures of surfaces and models say which numbers of the material are clamped.
sed 's/metalness: u/metalness: 2 + u/' on_model.cascade > shiny.cascade
run 0 run shiny.cascade --mesh square.obj --cells 2000 -o shiny.png
says err "the metalness goes from"
run 0 run on_model.cascade --mesh square.obj --cells 2000 -o even.png
grep -q "is clamped" out err && fail "numbers from 0 to 1 are said to be clamped"

# Numbers outside 0 … 1 are clamped and reported.
sed 's/roughness: .*/roughness: 2 * u/' waves.cascade > rough.cascade
run 0 run rough.cascade -o rough.glb --bake 32
says err "the roughness is not from 0 to 1 in 50 % of the cells, and is clamped there"
sed 's/opacity: .*/opacity: sqrt(-1 - u)/' waves.cascade > nan.cascade
run 0 run nan.cascade -o nan.glb --bake 32
says err "the opacity is not from 0 to 1 in 100 % of the cells, and is clamped there"

# Refused commands write no file.
run 64 run waves.cascade -o refused.glb --bake 9000
run 2 run waves.cascade -o refused.glb
says err "only models can be written to such files, but the domain is not a model"
says err "add --bake N for a rectangle with maps of N x N texels"
run 2 run waves.cascade -o refused.ply --bake 64
says err "only models can be written to such files"
run 2 run waves.cascade --bake 64
says err "this option writes maps of a model, but no such model is written"
says err "-o NAME.glb writes a rectangle with them"
run 3 run waves.cascade -o waves.glb -o waves_color.png --bake 64
says err "would both be written to waves_color.png"
for name in refused*; do [ ! -e "$name" ] || fail "$name was written"; done
