#!/usr/bin/env bash
# vtkImageFourierCenter puts the frequency zero one pixel beyond the middle.
#
# Expected. The filter moves the frequency zero of a transform to the centre of the image, so that spectra can be looked
# at. With n pixels along an axis this is pixel n/2, rounded down: the order is -2 -1 0 1 for four pixels and
# -2 -1 0 1 2 for five, as fftshift of NumPy and MATLAB has it. With an even n, the filter applied twice restores the
# image.
#
# What happens. Zero is at pixel n/2 + 1, and the highest positive frequency comes first: 1 -2 -1 0, and 2 -2 -1 0 1. So
# the spectrum of a real image with an odd n is not symmetric about the middle of the picture. With any n, the radius of
# a ring, from which one reads the wavelength of spots, is wrong by up to a pixel if it is measured from the middle.
# Applied twice, the filter shifts images of even size by two pixels.
#
# Workaround: measure from pixel n/2 + 1, or use numpy.fft.fftshift on the array.
#
# Seen with python3-vtk9 9.1.0 of Debian 12.
set -eu
for p in python3-vtk9=9.1.0; do
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
cat > try.py <<'EOF_PY'
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
def centred(numbers, times=1):
    image = vtk.vtkImageData()
    image.SetDimensions(len(numbers), 1, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(numpy.array(numbers, float), deep=1))
    for _ in range(times):
        centre = vtk.vtkImageFourierCenter()
        centre.SetInputData(image)
        centre.Update()
        image = centre.GetOutput()
    return vtk_to_numpy(image.GetPointData().GetScalars()).astype(int).tolist()
for n in range(4, 8):
    frequencies = (numpy.fft.fftfreq(n) * n).round()
    print(f"{n} pixels: {centred(frequencies)}, twice {centred(frequencies, 2)};",
          f"NumPy has {numpy.fft.fftshift(frequencies).astype(int).tolist()}")
# The same with a transform in two dimensions: the only number that is not 0 is the mean.
image = vtk.vtkImageData()
image.SetDimensions(8, 5, 1)
image.GetPointData().SetScalars(numpy_to_vtk(numpy.ones(40), deep=1))
transform, centre = vtk.vtkImageFFT(), vtk.vtkImageFourierCenter()
transform.SetInputData(image)
centre.SetInputConnection(transform.GetOutputPort())
centre.Update()
spectrum = vtk_to_numpy(centre.GetOutput().GetPointData().GetScalars())[:, 0].reshape(5, 8)
row, column = numpy.argwhere(abs(spectrum) > 1e-9)[0].tolist()
print(f"8 x 5 pixels: zero is at column {column}, row {row}, and the middle is at column 4, row 2")
EOF_PY
/usr/bin/python3 try.py | tee seen
cat > expected <<'EOF_TXT'
4 pixels: [1, -2, -1, 0], twice [-2, -1, 0, 1]; NumPy has [-2, -1, 0, 1]
5 pixels: [2, -2, -1, 0, 1], twice [-1, 0, 1, 2, -2]; NumPy has [-2, -1, 0, 1, 2]
6 pixels: [2, -3, -2, -1, 0, 1], twice [-2, -1, 0, 1, 2, -3]; NumPy has [-3, -2, -1, 0, 1, 2]
7 pixels: [3, -3, -2, -1, 0, 1, 2], twice [-1, 0, 1, 2, 3, -3, -2]; NumPy has [-3, -2, -1, 0, 1, 2, 3]
8 x 5 pixels: zero is at column 5, row 3, and the middle is at column 4, row 2
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
