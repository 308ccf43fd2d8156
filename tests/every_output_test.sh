#!/bin/bash
# Every kind of output, for every kind of script on every kind of domain, is written or refused before the first step. A
# bug report, a crash or a missing output is a failure.
set -u
failed=0
count=0
written=0
fail() {
    echo "every_output: $*"
    failed=1
}

fields='stage coat: turing_spots { iterations: 6; interval: 3'
cells='stage skin: scales { founders: 5; r: 0.08; duration: 0.4; interval: 2'
cp "$SOURCE/tests/support/octahedron.off" .
declare -A domains=(
    [line]='domain { grid: 12 }'
    [plane]='domain { grid: 12, 8 }'
    [mask]='domain { grid: 12, 8; mask: x < 0.7 }'
    [volume]='domain { grid: 8, 8, 6; boundary: noflux }'
    [surface]='domain { grid: 12, 8; surface: sx, sy, 0.1 * sin(6 * sx) }'
    [model]='domain { mesh: "octahedron.off"; cells: 60 }'
)
skin='picture { skin: rgb(coat.a, 0.5, 0.5) }'
declare -A scripts=(
    [fields]="$fields }"
    [coarse]="$fields; grid: coarse(2) }"
    [cells]="$cells }"
    [fields_cells]="$fields } $cells }"
    [skin]="$fields } $cells } $skin"
    [cells_fields]="$cells } $fields }"
    [body]="$fields } $cells; body: coat.a - 0.05 }"
    [picture_body]="$fields } picture { body: a - 0.5 }"
    [both_bodies]="$fields } $cells; body: coat.a - 0.05 } picture { body: coat.a - 0.5 }"
)
# Options for an output, and a file that must then exist.
outputs=(
    'film.gif -o film.gif'
    'film.apng -o film.apng --scale 4 --label step'
    'frames/0000-*.png --frames frames'
    'picture.png -o picture.png'
    'turn.gif -o turn.gif --turntable 2'
    'slices.gif -o slices.gif --slices 3'
    'rows.png -o rows.png --space-time'
    'FIGURE.SVG -o FIGURE.SVG'
    'model.glb -o model.glb'
    'model.ply -o model.ply'
    'MODEL.NPZ -o MODEL.NPZ'
    'sheet.png --sheet sheet.png'
    'volume.vti --volume volume.vti'
    'series.pvd --series series.pvd'
    'array.json --series array.npy'
    'grown.xdmf --series grown.h5'
    'line.csv --series line.csv'
    'fine.png -o fine.png --detail 2'
    'flat.gif -o flat.gif --flat'
    'stopped.gif -o stopped.gif --stop-at coat:3'
)
for domain in "${!domains[@]}"; do
    for script in "${!scripts[@]}"; do
        name="$domain.$script"
        printf '%s\n' "${domains[$domain]}" "${scripts[$script]}" >"$name.cascade"
        "$CASCADE" check "$name.cascade" >/dev/null 2>&1 || continue
        for output in "${outputs[@]}"; do
            read -r file options <<<"$output"
            # Without --size, pictures of planes have a pixel for each cell.
            case $domain.$script in line.fields | plane.fields | mask.fields) size= ;; *) size='--size 24x16' ;; esac
            rm -rf out && mkdir out
            count=$((count + 1))
            (cd out && "$CASCADE" run -q "../$name.cascade" --save saved $options $size >../out.txt 2>&1)
            status=$?
            case $status in
                0)
                    written=$((written + 1))
                    [ -e out/saved/run.json ] || fail "$name $options: nothing is saved"
                    compgen -G "out/$file" >/dev/null || fail "$name $options: no $file"
                    ;;
                2 | 3) [ ! -e out/saved/run.json ] || fail "$name $options: fails after its steps, $(cat out.txt)" ;;
                *) fail "$name $options: status $status, $(cat out.txt)" ;;
            esac
            [ -z "${TABLE-}" ] || echo "$status $name $options"
        done
    done
done
echo "$count outputs, of which $written are written and the others refused"
exit $failed
