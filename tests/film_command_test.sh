#!/bin/bash
# Films from the command line: files, messages, and results after Ctrl-C.
set -u
failed=0
fail() {
    echo "film: $*"
    failed=1
}

cat > spots.cascade <<'END'
domain { grid: 24, 16 }
stage s: turing_spots { iterations: 60; interval: 20 }
END

# The number of frames of a GIF: each has a control block.
gif_frames() { LC_ALL=C grep -aoP '\x21\xf9\x04' "$1" | wc -l; }

"$CASCADE" run spots.cascade -o film.gif -o film.webp -o film.apng >out 2>err || fail "$(cat err)"
for ending in gif webp apng; do
    grep -q "^wrote film.$ending$" out || fail "nothing is said of film.$ending"
done
[ "$(gif_frames film.gif)" = 4 ] || fail "the GIF has $(gif_frames film.gif) frames"
[ "$(head -c 6 film.gif)" = GIF89a ] || fail "the GIF is none"
[ "$(head -c 12 film.webp | tail -c 4)" = WEBP ] || fail "the WebP is none"
grep -aq acTL film.apng || fail "the APNG is not animated"
[ ! -e spots.png ] || fail "a film brings a picture"

# An APNG contains its script: run as a picture, it gives the same film.
cp film.apng again.png
"$CASCADE" run again.png -q -o again.gif || fail "an APNG does not run again"
cmp -s film.gif again.gif || fail "the film of an APNG is another one"

# Bits do not depend on threads.
for ending in gif webp apng; do
    "$CASCADE" run spots.cascade -q --threads 1 -o "one.$ending" || fail "one thread"
    "$CASCADE" run spots.cascade -q --threads 4 -o "four.$ending" || fail "four threads"
    cmp -s "one.$ending" "four.$ending" || fail "threads change a film ($ending)"
done

# Refused with a reason, and no file is left.
refused() {
    local text=$1
    shift
    rm -f bad.*
    "$CASCADE" run spots.cascade "$@" >/dev/null 2>err && fail "$* is taken"
    grep -qF -- "$text" err || fail "$*: no '$text' in: $(cat err)"
    compgen -G 'bad.*' >/dev/null && fail "$* leaves $(echo bad.*)"
    compgen -G '.cascade-*' >/dev/null && fail "$* leaves a temporary file"
}
refused "is a film in a format that Cascade cannot write" -o bad.avi
refused "a GIF shows at most 50 frames a second" -o bad.gif --fps 55
refused "no film is written" --fps 5 -o bad.png
refused "no film is written" --seconds 5 --sheet bad.png
refused "has no frames" -o bad.gif --steps 0
refused "cannot hold frames of 16384 × 64 pixels" --grid 256x1 --scale 64 -o bad.webp
refused "there is no folder 'none'" -o none/bad.gif
refused "the domain is not a surface" -o bad.gif --turntable 4
refused "does not end in .png" --sheet bad.gif
PATH=/none "$CASCADE" run spots.cascade -o bad.mp4 >/dev/null 2>err && fail "an MP4 without ffmpeg"
grep -q "needs the program ffmpeg, which is not installed" err || fail "without ffmpeg: $(cat err)"
grep -q "apt-get install ffmpeg" err || fail "without ffmpeg: $(cat err)"
[ ! -e bad.mp4 ] || fail "there is an MP4 without ffmpeg"
for command in check view; do
    "$CASCADE" "$command" spots.cascade --fps 5 >/dev/null 2>err && fail "$command takes --fps"
    grep -q "there is no option --fps" err || fail "$command: $(cat err)"
done
if [ "$(id -u)" != 0 ]; then
    mkdir -p closed && chmod 500 closed
    refused "Permission denied" -o closed/bad.gif
    chmod 700 closed
fi

"$CASCADE" sweep spots.cascade --vary ka=1/80,1/40 --fps 5 >/dev/null 2>err && fail "a sweep takes --fps"
grep -q -- "add --film NAME.gif" err || fail "sweep: $(cat err)"
refused "this domain is a plane, which has no slices" -o bad.gif --slices 4
refused "--label needs frames or a film, but none is written" -o bad.png --label step
refused "no room for a label" -o bad.gif --label step
refused "this value differs from cell to cell" -o bad.gif --label b

# Surfaces without a background have transparent films, if the format has transparency.
echo 'domain { surface: sphere; cells: 200 }' >ball.cascade
echo 'stage s: turing_spots { iterations: 4 }' >>ball.cascade
ball() { "$CASCADE" run -q ball.cascade --size 48x36 --background none "$@" >/dev/null 2>err; }
ball --turntable 2 -o ball.gif -o ball.webp -o ball.apng || fail "a film without background: $(cat err)"
ball --turntable 2 -o ball.mp4 && fail "an MP4 without background"
grep -q "an MP4 film has no transparent pixels" err || fail "an MP4 without background: $(cat err)"
[ ! -e ball.mp4 ] || fail "there is an MP4 without background"
ball -o ball.png --label step --frames balls || fail "a picture without background: $(cat err)"
[ "$(od -An -t u1 -j 25 -N 1 ball.png | tr -d ' ')" = 4 ] || fail "a grey picture without background has no alpha"

# Labels, and films of sweeps and volumes.
"$CASCADE" run spots.cascade -q --scale 8 -o label.gif --label stage --label step || fail "a label"
"$CASCADE" run spots.cascade -q --scale 8 -o plain.gif || fail "no label"
cmp -s label.gif plain.gif && fail "a label is not drawn"
"$CASCADE" sweep spots.cascade -q --vary ka=1/80,1/40,1/20 --film sweep.gif || fail "a sweep as a film"
[ "$(gif_frames sweep.gif)" = 3 ] || fail "the film of a sweep has $(gif_frames sweep.gif) frames"
"$CASCADE" run spots.cascade -q --grid 12x10x8 --slices 8 -o slices.gif || fail "slices"
[ "$(gif_frames slices.gif)" = 8 ] || fail "the film of slices has $(gif_frames slices.gif) frames"

# After Ctrl-C the film shows the run up to that moment.
timeout --preserve-status -s INT 2 "$CASCADE" run spots.cascade --set iterations=1000000000 \
    --set interval=1000 -o stopped.gif >out 2>err
status=$?
[ "$status" = 130 ] || fail "a stopped run has status $status"
[ "$(gif_frames stopped.gif)" -ge 1 ] || fail "a stopped run has no film"
[ "$(tail -c 1 stopped.gif)" = ';' ] || fail "the film of a stopped run has no end"

# An encoder that hangs or reports false success: the program does not wait for it after a signal, and reports no film
# as written.
mkdir -p bin
stand_in() { printf '#!/bin/sh\n%s\n' "$1" >bin/ffmpeg && chmod 755 bin/ffmpeg; }
with_stand_in() { PATH=$PWD/bin:$PATH timeout "$@" >out 2>err; }
no_film() {
    [ ! -e lie.mp4 ] || fail "$1: there is a film"
    grep -q "^wrote" out && fail "$1: $(cat out)"
    compgen -G '.cascade-*' >/dev/null && fail "$1 leaves a temporary file"
}
stand_in 'exec sleep 100'
for how in "-s TERM 2:143" "-s INT 2:130" "60:124 --limit-time 1s"; do
    read -r limit options <<<"${how#*:}"
    with_stand_in --preserve-status ${how%%:*} "$CASCADE" run spots.cascade -o lie.mp4 $options
    status=$?
    [ "$status" = "$limit" ] || fail "an encoder that hangs ($how): status $status, $(cat err)"
    grep -q "at the trial of ffmpeg; nothing has been written" err || fail "$how: $(cat err)"
    no_film "an encoder that hangs"
done
# An encoder that hangs after all frames: the run is still saved.
stand_in 'case "$*" in *null*) cat >/dev/null ;; *) cat >/dev/null; sleep 100 ;; esac'
with_stand_in --preserve-status -s TERM 3 "$CASCADE" run spots.cascade -o lie.mp4 --save kept
grep -q "it made no progress and was stopped" err || fail "an encoder that hangs at the end: $(cat err)"
grep -q "written all the same: kept" err || fail "an encoder that hangs at the end: $(cat err)"
"$CASCADE" run --resume kept -q -o kept.png || fail "the run is not saved"
no_film "an encoder that hangs at the end"
for lie in 'exit 0' 'head -c 1000 >/dev/null' 'cat >/dev/null' 'for f; do :; done; cat >"${f#file:}"'; do
    stand_in "case \"\$*\" in *null*) cat >/dev/null ;; *) $lie ;; esac"
    with_stand_in 60 "$CASCADE" run spots.cascade -o lie.mp4
    status=$?
    [ "$status" = 3 ] || fail "an encoder that lies ($lie): status $status"
    grep -q "ffmpeg could not write 'lie.mp4'" err || fail "$lie: $(cat err)"
    no_film "$lie"
done
stand_in 'cat >/dev/null'
with_stand_in 60 "$CASCADE" sweep spots.cascade -q --vary ka=1/80,1/40 --film lie.mp4 && fail "a sweep believes a lie"

# With ffmpeg, if it is installed.
if command -v ffmpeg >/dev/null && command -v ffprobe >/dev/null; then
    for ending in mp4 webm; do
        "$CASCADE" run spots.cascade -q -o "film.$ending" --fps 12.5 || fail "$ending"
        found=$(ffprobe -v error -count_frames -of csv=p=0 \
            -show_entries stream=width,height,nb_read_frames,r_frame_rate "film.$ending")
        [ "$found" = 24,16,25/2,4 ] || fail "film.$ending: $found"
    done
    compgen -G '.cascade-*' >/dev/null && fail "ffmpeg leaves a temporary file"
fi
exit $failed
