#!/bin/sh
# Sums on a lattice with the springs of either stabilization, families by lists, subcycled, quadratic, ordinary, contact,
# bonds that break in each way, and equilibria, on 1, 2 and 4 threads of a rank: frames and histories must be the same to
# the last bit; and so must the error of a run that fails. Frames of two ranks of three threads, too. An
# invalid number of threads is refused.
#   threads.sh strut strut-mesh strut-compare mpirun [its options]
set -u
strut=$1 mesh=$2 compare=$3
shift 3
mpirun=$*

export OMP_WAIT_POLICY=passive  # there are fewer cores than threads
. "$(dirname "$0")/problems.sh"

failures=0
fail() {
  echo "FAILED: $1"
  failures=$((failures + 1))
}

# run NAME RANKS THREADS: writes NAME.e, NAME.csv and NAME.log
run() {
  deck $1 > deck.xml
  launcher="$mpirun -n $2"
  [ $2 -gt 1 ] || launcher=
  $launcher "$strut" --threads $3 deck.xml > $1.log 2>&1
}

# said NAME WORDS: that the run does what it is here for.
said() {
  grep -q "$2" ${1}1.log || { cat ${1}1.log; fail "$1 is not $2"; }
}

end=1e-4
for name in bar silling fast cells mixed breaking cracking tearing rending snapping touching slow; do
  problem $name
  if ! run ${name}1 1 1; then
    cat ${name}1.log
    fail "the run of $name"
    continue
  fi
  case $name in
    fast | cells) said $name subcycled ;;
    breaking | cracking | tearing | rending | snapping) said $name 'bonds are broken' ;;
  esac
  case $name in bar | mixed) several="2 4" ;; *) several=4 ;; esac
  for threads in $several; do
    run $name$threads 1 $threads || fail "the run of $name on $threads threads"
    "$compare" ${name}1.e $name$threads.e --relative 0 > difference || cat difference
    grep -q '^the same' difference || fail "the fields of $name on $threads threads"
    cmp ${name}1.csv $name$threads.csv || fail "the history of $name on $threads threads"
  done
done

problem bar
run ranks 2 3 || fail "two ranks of three threads"
"$compare" bar1.e ranks.e --relative 0 > difference || fail "the fields on two ranks of three threads"

# So fast that many points are turned inside out in the same step: the same one is told of.
problem bar
speed=20000
for threads in 1 4; do
  run wild$threads 1 $threads && fail "$threads threads go on where a point is turned inside out"
  grep -E 'inside out|not a number|no stress' wild$threads.log > told$threads
done
[ -s told1 ] || { cat wild1.log; fail "no failure was told"; }
cmp told1 told4 || fail "what is told of a failure"

for threads in 0 -1 1025 two 2.5 99999999999 ''; do
  $mpirun -n 2 "$strut" --threads "$threads" deck.xml > log 2>&1 && fail "--threads '$threads' was taken"
  told=$(grep -c -- "'--threads' needs a whole number, 1 to 1024, not '$threads'" log)
  [ "$told" -eq 1 ] || { cat log; fail "what is told of --threads '$threads'"; }
done
$mpirun -n 1 "$strut" --threads 2 > log 2>&1
grep -q -- "'--threads' needs a number, and a deck" log || fail "--threads without a deck"

[ $failures -eq 0 ] && echo "passed"
exit $((failures > 0))
