"""Branches of steady states by AUTO-07p (Debian's auto-07p) on the grid of a line of cells without flux at its ends."""

import os
import re
import subprocess

AUTO = "/usr/lib/auto-07p"

EQUATIONS = """
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  integer :: k, s, before, after
  integer, parameter :: n = {cells}, m = {species}
  double precision :: p, c(m), l(m), r(m)
  p = par(1)
  do k = 1, n
    before = max(k - 1, 1)
    after = min(k + 1, n)
    do s = 1, m
      c(s) = u((k - 1) * m + s)
      l(s) = (u((before - 1) * m + s) - 2 * c(s) + u((after - 1) * m + s)) / {spacing}d0**2
    end do
    {rates}
    do s = 1, m
      f((k - 1) * m + s) = r(s)
    end do
  end do
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  integer :: k
  integer, parameter :: n = {cells}, m = {species}
  double precision :: p, c(m)
  p = {start}d0
  par(1) = p
  {flat}
  do k = 1, n
    u((k - 1) * m + 1 : k * m) = c
  end do
end subroutine stpnt

subroutine bcnd
end subroutine bcnd
subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt
subroutine pvls
end subroutine pvls
"""

CONSTANTS = """NDIM={ndim}
IPS=1
IRS={restart}
ILP=1
ICP=[1]
NTST=1
NCOL=4
IAD=3
ISP=2
ISW={switch}
MXBF=0
NMX={points}
RL0={low}
RL1={high}
A0=0
A1=1e9
NPR={points}
IID=2
ITMX=9
ITNW=7
NWTN=3
JAC=0
EPSL=1e-10
EPSU=1e-10
EPSS=1e-9
DS={step}
DSMIN=1e-6
DSMAX={longest}
IADS=1
"""

KINDS = {1: "branch point", 2: "fold", 3: "Hopf point", 5: "fold", 6: "branch point"}


def is_installed():
    return os.path.isdir(AUTO)


def _run(folder, constants):
    with open(os.path.join(folder, "c.line"), "w") as file:
        file.write(constants)
    environment = dict(os.environ, AUTO_DIR=AUTO, PATH=f"{AUTO}/cmds:{AUTO}/bin:{os.environ['PATH']}")
    return subprocess.run(["bash", f"{AUTO}/cmds/@r", "line"], cwd=folder, env=environment, text=True,
                          capture_output=True, check=True).stdout


def prepare(folder, system):
    """Writes the equations. `system` has cells, species, spacing, rates, flat and start."""
    with open(os.path.join(folder, "line.f90"), "w") as file:
        file.write(EQUATIONS.format(**system))


def branch(folder, system, low, high, restart=0, switch=1, points=200, step=0.01, longest=0.05):
    """The rows of a branch: (kind or None, label, parameter, norm), with the root of the sum of all squares as norm."""
    if restart:
        os.replace(os.path.join(folder, "fort.8"), os.path.join(folder, "s.line"))
    _run(folder, CONSTANTS.format(ndim=system["cells"] * system["species"], restart=restart, switch=switch,
                                  points=points, low=low, high=high, step=step, longest=longest))
    rows = []
    with open(os.path.join(folder, "fort.7")) as file:
        for line in file:
            words = line.split()
            if len(words) < 6 or words[0] == "0" or not re.fullmatch(r"-?\d+", words[0]):
                continue
            kind = KINDS.get(abs(int(words[2])) % 10)
            rows.append((kind, int(words[3]), float(words[4]), float(words[5])))
    return rows
