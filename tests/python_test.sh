#!/usr/bin/env bash
# Tests `import cascade` (tests/python), and runs the examples of docs/python.md and docs/tutorial_python.md, one after
# the other, and the cells of the notebook examples/python/tutorial.ipynb. Skipped if the module is not built because
# pybind11 or Python's headers are missing.
set -eu
python=$(sed -n 's/^Python3_EXECUTABLE:.*=//p' "$BUILD/CMakeCache.txt")
compgen -G "$BUILD/python/cascade/_core*.so" >/dev/null && "$python" -c 'import numpy' 2>/dev/null || exit 77
[ -z "$SANITIZE" ] || exit 77  # Python itself is not built with sanitizers.
export PYTHONPATH=$BUILD/python PYTHONDONTWRITEBYTECODE=1

rm -rf ./*
"$python" -m unittest discover -s "$SOURCE/tests/python" -p 'use_*.py' 2>test.log || { cat test.log; exit 1; }
grep -q '^Ran [3-9][0-9] tests' test.log || { cat test.log; exit 1; }

mkdir page notebook
cd page
cp "$SOURCE/examples/leopard.cascade" .
sed -n '/^```python$/,/^```$/{/^```/d;p}' "$SOURCE/docs/python.md" >examples.py
[ "$(wc -l <examples.py)" -ge 50 ] || { echo "docs/python.md has no examples"; exit 1; }
"$python" examples.py >examples.out || exit 1
sed -n '/^```python$/,/^```$/{/^```/d;p}' "$SOURCE/docs/tutorial_python.md" >tutorial.py
[ "$(wc -l <tutorial.py)" -ge 40 ] || { echo "docs/tutorial_python.md has no examples"; exit 1; }
"$python" tutorial.py >tutorial.out || exit 1

# The notebook shows its last cell as a page, which needs the engine.
[ -e "$BUILD/engine.wasm" ] || exit 0
cd ../notebook
"$python" "$SOURCE/tests/python/run_notebook.py" "$SOURCE/examples/python/tutorial.ipynb" >cells.out 2>errors.out ||
    { cat cells.out errors.out; exit 1; }
[ "$(grep -c '^cell ' cells.out)" -ge 10 ] || { echo "the notebook has too few cells"; cat cells.out; exit 1; }
[ "$(grep -c 'a picture$' cells.out)" -ge 3 ] && [ "$(grep -c 'HTML$' cells.out)" -ge 2 ] || { cat cells.out; exit 1; }
