#!/bin/sh
# Runs a problem on 1, 2, and 3 or 4 ranks: results and histories must be the same. The problems (problems.sh) are a Taylor
# impact, a fast one whose foot is subcycled, the same with points at the nodes of a graded mesh, also by quadratic
# correspondence, a bar whose upper half is ordinary elastic below either formulation, and two bodies that meet with
# friction, also so fast that they break, by stretch, gradually, by failure or energy, also on a lattice and with the
# springs of the mean gradient.
#   invariance.sh problem strut strut-mesh strut-compare mpirun [its options]
set -u
name=$1 strut=$2 mesh=$3 compare=$4
shift 4  # "$@" is mpirun now

. "$(dirname "$0")/problems.sh"

# Families are in the order of ids and the step's estimate sums reproducibly, so fields have the same bits on any ranks, also where points
# are spread over them anew on the way, as nearly each problem makes them be. Totals are sums over ranks and differ by round-off, 1e-15 of
# their terms. 1e-9 of the largest value leaves room for that, and for a mistake in one point (a family, a ghost, a sum) it is far too small.
# All columns of the history have such a measure: Balance_Error is about 1e-3, the lateral momenta count with the axial one.
failures=0
problem $name
case $name in fast | cells | touching | tearing | rending | snapping) others="2 4" ;; *) others="2 3" ;; esac
for ranks in 1 $others; do
  deck $name$ranks > deck.xml
  if ! "$@" -n $ranks "$strut" deck.xml > log 2>&1; then
    echo "FAILED: the run of $name on $ranks ranks"
    cat log
    exit 1
  fi
  [ $ranks -eq 1 ] && grep -E ' steps, |subcycled|bonds are broken' log
  if { [ $name = fast ] || [ $name = cells ]; } && ! grep -qE 'subcycled' log; then
    echo "FAILED: no point of the bar $name is subcycled"
    exit 1
  fi
  case $name in breaking | softening | cracking | tearing | rending | snapping)
    if ! grep -q 'bonds are broken' log; then
      echo "FAILED: no bond broke"
      exit 1
    fi ;;
  esac
  case $name$ranks in fast4 | cells[24] | touching4 | tearing[24] | rending4 | snapping4)
    if ! grep -q 'spread over the ranks anew' log; then
      echo "FAILED: the partition of $name stays as it is"
      exit 1
    fi ;;
  esac
  echo "$name, $ranks ranks:"
  "$compare" ${name}1.e $name$ranks.e --relative 0 || failures=$((failures + 1))
  "$compare" ${name}1.csv $name$ranks.csv --relative 1e-9 || failures=$((failures + 1))
done
[ $failures -eq 0 ] && echo "passed"
exit $((failures > 0))
