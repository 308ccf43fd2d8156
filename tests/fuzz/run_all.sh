#!/usr/bin/env bash
# run_all.sh MINUTES: all fuzzers share MINUTES, one after the other, and continue from what they found before
# (build/corpora/NAME); then the tests run under the sanitizers of addresses, undefined behaviour and
# threads, as often as MINUTES allow and at least once, their random parts with new seeds.
# Failures: an input crash-…, timeout-… or oom-… in build/corpora, or a test and its seed.
#
#     FUZZERS="picture kept" tests/fuzz/run_all.sh 10    only these
#     FIXED_RUNS=1 …                                 each takes its number of inputs below, however long that is
#     SANITIZERS="thread" …                              only these presets; "" for none
set -eu
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
minutes=${1:?how many minutes?}
read -ra fuzzers <<<"${FUZZERS-front_end model picture saved_run kept prompt page_message lsp}"
read -ra sanitizers <<<"${SANITIZERS-sanitize thread}"
jobs=${JOBS:-$(nproc)}
failed=()

# The number of inputs for one or two minutes on one core.
declare -A inputs=([front_end]=20000 [model]=500000 [picture]=2000000 [saved_run]=60000 [kept]=500000 [prompt]=5000
    [page_message]=500000 [lsp]=20000)

note() { printf '\n== %s\n' "$*"; }

if [ ${#fuzzers[@]} -gt 0 ]; then
    note "building the fuzzers"
    cmake --preset fuzz >/dev/null
    cmake --build --preset fuzz -j "$jobs" --target "${fuzzers[@]/%/_fuzzer}"
    seconds=$((minutes * 60 / ${#fuzzers[@]}))
    # Only scripts, since the pictures beside them are large and their messages slow.
    scripts=build/corpora/scripts
    mkdir -p "$scripts"
    find examples lang/systems -name '*.cascade' | while read -r path; do
        cp "$path" "$scripts/${path//\//_}"  # Some names occur in several folders.
    done
    for name in "${fuzzers[@]}"; do
        corpus=build/corpora/$name
        mkdir -p "$corpus"
        seeds=("$corpus")
        options=()
        case $name in
            front_end | prompt) seeds+=("$scripts") options+=(-dict=tests/fuzz/cascade.dict) ;;
        esac
        limit=-max_total_time=$seconds
        [ -z "${FIXED_RUNS-}" ] || limit=-runs=${inputs[$name]}
        [ "$name" = model ] && options+=(-dict=tests/fuzz/models.dict)
        note "$name, $limit, $(find "$corpus" -type f | wc -l) inputs known"
        log=build/corpora/$name.log
        if build/fuzz/tests/fuzz/"$name"_fuzzer "${options[@]}" -print_funcs=0 -max_len=4096 \
            -timeout=10 -malloc_limit_mb=256 "$limit" -print_final_stats=1 \
            -artifact_prefix=build/corpora/ "${seeds[@]}" >"$log" 2>&1; then
            grep -E 'number_of_executed_units|average_exec_per_sec' "$log"
        else
            failed+=("$name")
            grep -vE '^#|NEW_FUNC' "$log" | tail -n 40
        fi
    done
fi

for preset in "${sanitizers[@]}"; do
    note "tests, preset $preset"
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset" -j "$jobs"
    end=$((SECONDS + minutes * 60))
    while :; do
        ctest --preset "$preset" -j "$jobs" || { failed+=("$preset"); break; }
        [ $SECONDS -lt $end ] || break
    done
done

note "${#failed[@]} failed ${failed[*]}"
[ ${#failed[@]} -eq 0 ]
