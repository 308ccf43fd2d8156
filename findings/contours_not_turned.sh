#!/usr/bin/env bash
# vtkContourFilter and most filters of VTK forget that an image is turned.
#
# Expected. Since VTK 9 an image has a direction matrix beside origin and spacing. It is kept in .vti files and
# used by bounds, points and probes. Contours of a turned image should be turned with it, and an image that is
# smoothed or cast to another type should stay where it is.
#
# What happens. vtkFlyingEdges2D and 3D and vtkMarchingCubes turn their contours. vtkContourFilter, the one that
# everybody uses and that says it picks the fastest method for the input, leaves them unturned: the surface u = 1.5
# appears as x = 1.5 instead of y = 1.5, beside or across the image to which it belongs. vtkImageCast, ShiftScale,
# Resample, Median and GaussianSmooth return an image without the direction; so do the legacy and the MetaImage
# writers. Nothing warns.
#
# Workaround: vtkFlyingEdges; or give images no direction and turn the result by an actor or a vtkTransformFilter.
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
from vtk.util.numpy_support import vtk_to_numpy
image = vtk.vtkImageData()
image.SetDimensions(5, 4, 3)
image.SetDirectionMatrix(0, 1, 0, 1, 0, 0, 0, 0, 1)  # the first index runs along y, the second along x
image.AllocateScalars(vtk.VTK_DOUBLE, 1)
vtk_to_numpy(image.GetPointData().GetScalars())[:] = numpy.tile(numpy.arange(5.), 12)  # u = first index = y
def show(name, data):
    b = data.GetBounds()
    print(f"{name}: x {b[0]:g} to {b[1]:g}, y {b[2]:g} to {b[3]:g}")
show("the image", image)
for name in "vtkFlyingEdges3D", "vtkMarchingCubes", "vtkContourFilter", "vtkSynchronizedTemplates3D":
    contour = getattr(vtk, name)()
    contour.SetInputData(image)
    contour.SetValue(0, 1.5)
    contour.Update()
    show("u = 1.5 by " + name, contour.GetOutput())
for name in "ExtractVOI", "ImageCast", "ImageShiftScale", "ImageResample", "ImageMedian3D", "ImageGaussianSmooth":
    change = getattr(vtk, "vtk" + name)()
    change.SetInputData(image)
    if name == "ExtractVOI":
        change.SetVOI(0, 4, 0, 3, 0, 2)
    change.Update()
    show("the image after vtk" + name, change.GetOutput())
for writer, reader, name in ((vtk.vtkXMLImageDataWriter, vtk.vtkXMLImageDataReader, "a.vti"),
                             (vtk.vtkDataSetWriter, vtk.vtkDataSetReader, "a.vtk"),
                             (vtk.vtkMetaImageWriter, vtk.vtkMetaImageReader, "a.mha")):
    w, r = writer(), reader()
    w.SetInputData(image)
    w.SetFileName(name)
    w.Write()
    r.SetFileName(name)
    r.Update()
    show("the image by way of " + name, r.GetOutput())
EOF_PY
python3 try.py | tee seen
cat > expected <<'EOF_TXT'
the image: x 0 to 3, y 0 to 4
u = 1.5 by vtkFlyingEdges3D: x 0 to 3, y 1.5 to 1.5
u = 1.5 by vtkMarchingCubes: x 0 to 3, y 1.5 to 1.5
u = 1.5 by vtkContourFilter: x 1.5 to 1.5, y 0 to 3
u = 1.5 by vtkSynchronizedTemplates3D: x 1.5 to 1.5, y 0 to 3
the image after vtkExtractVOI: x 0 to 3, y 0 to 4
the image after vtkImageCast: x 0 to 4, y 0 to 3
the image after vtkImageShiftScale: x 0 to 4, y 0 to 3
the image after vtkImageResample: x 0 to 4, y 0 to 3
the image after vtkImageMedian3D: x 0 to 4, y 0 to 3
the image after vtkImageGaussianSmooth: x 0 to 4, y 0 to 3
the image by way of a.vti: x 0 to 3, y 0 to 4
the image by way of a.vtk: x 0 to 4, y 0 to 3
the image by way of a.mha: x 0 to 4, y 0 to 3
EOF_TXT
cmp -s seen expected || { echo "CHANGED: this was seen before:"; cat expected; exit 1; }
echo "still so"
