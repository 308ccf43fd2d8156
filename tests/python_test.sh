#!/usr/bin/env bash
# `import cascade` keeps its promises (tests/python/use_module.py), and the examples of docs/python.md run, one after
# the other. Skipped where the module is not built, for want of pybind11 or Python's headers.
set -eu
python=$(sed -n 's/^Python3_EXECUTABLE:.*=//p' "$BUILD/CMakeCache.txt")
compgen -G "$BUILD/python/cascade/_core*.so" >/dev/null && "$python" -c 'import numpy' 2>/dev/null || exit 77
[ -z "$SANITIZE" ] || exit 77  # Python itself is not built with sanitizers.
export PYTHONPATH=$BUILD/python PYTHONDONTWRITEBYTECODE=1

rm -rf saved* ./*.png
"$python" "$SOURCE/tests/python/use_module.py" 2>test.log || { cat test.log; exit 1; }
grep -q '^Ran [1-9][0-9] tests' test.log || { cat test.log; exit 1; }

cp "$SOURCE/examples/leopard.cascade" .
sed -n '/^```python$/,/^```$/{/^```/d;p}' "$SOURCE/docs/python.md" >examples.py
[ "$(wc -l <examples.py)" -ge 20 ] || { echo "docs/python.md has no examples"; exit 1; }
"$python" examples.py >examples.out || exit 1
