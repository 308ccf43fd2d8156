#!/usr/bin/env bash
# The length of --log agrees with NumPy's Fourier transform of the field in an HDF5 file, and the example
# examples/python/coarsening.py finds an exponent near 1/3. Skipped without h5py and numpy.
set -u
rm -rf ./*

about="coarsening"
source "$SOURCE/tests/support/program_runs.bash"
for python in python3 /usr/bin/python3; do
    "$python" -c 'import h5py, numpy' 2>/dev/null && break
    python=
done
[ -n "$python" ] && [ -e "$BUILD/libcascade_hdf5.so" ] || { echo "$about: h5py or numpy or HDF5 is not there"; exit 77; }

cat >waves.cascade <<'END'
domain { grid: 48, 48; spacing: 0.5; precision: double }
stage coarsening: cahn_hilliard { solver: imex; speed: 0.1; iterations: 400; interval: 100 }
END
run 0 run waves.cascade -q -o waves.png --series waves.h5 --log length --log wavelength --log-file log.csv
"$python" - <<'END' || fail "the length differs"
import csv, h5py, numpy
logged = [float(row["length"]) for row in csv.DictReader(open("log.csv"))]
with h5py.File("waves.h5") as file:
    fields = file["c"][:]
assert len(logged) == len(fields) == 5
for length, field in zip(logged, fields):
    power = abs(numpy.fft.fft2(field - field.mean())) ** 2
    waves = [numpy.fft.fftfreq(n, 0.5) for n in field.shape]
    k = numpy.hypot(waves[0][:, None], waves[1][None, :])
    ring = numpy.rint(k * 24).astype(int).ravel()        # The longest side is 24 long.
    modes = numpy.maximum(numpy.bincount(ring), 1)
    factor = numpy.bincount(ring, power.ravel()) / modes
    moment = numpy.bincount(ring, (power * k).ravel()) / modes
    assert abs(factor[1:].sum() / moment[1:].sum() / length - 1) < 1e-9, length
END
echo 'system flat { u: 1; u'"'"' = 0 } stage a: flat { iterations: 1 }' >flat.cascade
run 0 run flat.cascade -q -o flat.png --log length --log-file flat.csv
[ "$(tail -n 1 flat.csv)" = "a,1,1," ] || fail "a uniform field has a length: $(cat flat.csv)"

CASCADE=$CASCADE "$python" "$SOURCE/examples/python/coarsening.py" 64 400 2 >out 2>err || fail "the example ends badly"
"$python" - <<'END' || fail "$(cat out)"
import csv, re
n = float(re.match(r"n = ([0-9.]+)", open("out").read()).group(1))
assert 0.2 < n < 0.5, n
structure = [(float(row["k"]), float(row["S"])) for row in csv.DictReader(open("structure.csv"))]
assert len(structure) == 33 and 0 < max(structure, key=lambda row: row[1])[0] < 0.2
pairs = [float(row["g"]) for row in csv.DictReader(open("pairs.csv"))]
assert pairs[0] == 1 and min(pairs) < 0 and abs(pairs[-1]) < 0.5
END
exit 0
