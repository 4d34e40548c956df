#!/bin/sh
# A run that is ended by a signal stops at the end of a step, and what it has written can be read.
#   signals.sh strut strut-mesh strut-compare mpirun [its options]
set -u
strut=$1 mesh=$2 compare=$3
shift 3  # "$@" is mpirun now

folder=$(mktemp -d "${TMPDIR:-/tmp}/strut-signals-XXXXXX")
cd "$folder" || exit 1
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

cat > bar.recipe <<END
shape = box
size = 4e-3 4e-3 8e-3
spacing = 1e-3
END
"$mesh" bar.recipe bar.g > mesh.log || { cat mesh.log; exit 1; }

# condition NAME TYPE SET AXIS VALUE
condition() {
  cat <<END
    <ParameterList name="$1">
      <Parameter name="Type" type="string" value="$2"/>
      <Parameter name="Node Set" type="string" value="$3"/>
      <Parameter name="Coordinate" type="string" value="$4"/>
      <Parameter name="Value" type="string" value="$5"/>
    </ParameterList>
END
}

# Hours of computing, if nothing ends it. $conditions, $solver: the content of sections; $frequency: of the history.
write_deck() {
  cat > deck.xml <<END
<ParameterList>
  <ParameterList name="Discretization">
    <Parameter name="Type" type="string" value="Exodus"/>
    <Parameter name="Input Mesh File" type="string" value="bar.g"/>
  </ParameterList>
  <ParameterList name="Materials">
    <ParameterList name="copper">
      <Parameter name="Material Model" type="string" value="Elastic Correspondence"/>
      <Parameter name="Density" type="double" value="8930"/>
      <Parameter name="Young's Modulus" type="double" value="117e9"/>
      <Parameter name="Poisson's Ratio" type="double" value="0.35"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Blocks">
    <ParameterList name="bar">
      <Parameter name="Block Names" type="string" value="all"/>
      <Parameter name="Material" type="string" value="copper"/>
      <Parameter name="Horizon" type="double" value="2.01e-3"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Node Sets">
    <Parameter name="low" type="string" value="z &lt; 1e-3"/>
    <Parameter name="high" type="string" value="z &gt; 7e-3"/>
  </ParameterList>
  <ParameterList name="Boundary Conditions">$conditions</ParameterList>
  <ParameterList name="Solver">
    <Parameter name="Final Time" type="double" value="10"/>
    $solver
  </ParameterList>
  <ParameterList name="Output">
    <Parameter name="Output Filename" type="string" value="result.e"/>
    <Parameter name="Output Frequency" type="int" value="200"/>
    <ParameterList name="Output Variables">
      <Parameter name="Displacement" type="bool" value="true"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="History">
    <Parameter name="Filename" type="string" value="history.csv"/>
    <Parameter name="Frequency" type="int" value="$frequency"/>
  </ParameterList>
</ParameterList>
END
}

# Until the run has written 20 lines, or 40 s: a busy machine takes its time.
wait_for_lines() {
  tries=400
  while [ "$(wc -l 2> /dev/null < history.csv || echo 0)" -lt 20 ]; do
    tries=$((tries - 1))
    [ $tries -gt 0 ] || { fail "$1: the run has not begun"; cat log; return; }
    sleep 0.1
  done
}

# Every line ends and has as many numbers as the header has names. The last is as true as the others: its Balance_Error
# (column 13) swings up to 1.5e-3 within 400,000 steps; with energies of another step, which change by a tenth within a
# few, it would be 1e-1.
check_results() {
  "$compare" result.e result.e > compare.log 2>&1 || { fail "$1: the result cannot be read"; cat compare.log; }
  "$compare" history.csv history.csv > compare.log 2>&1 || { fail "$1: the history cannot be read"; cat compare.log; }
  [ -z "$(tail -c 1 history.csv)" ] || fail "$1: the last line of the history is cut off"
  awk -F , '/^#/ { next } !n { n = NF } NF != n { exit 1 }' history.csv || fail "$1: the history has lines of different lengths"
  awk -F , '{ last = $13 + 0 } END { exit !(last <= 5e-3) }' history.csv ||
    { fail "$1: the ledger of the last step does not balance"; tail -n 3 history.csv; }
}

# run NAME TARGET SIGNAL command…, run_and_check …: starts the command, sends SIGNAL to the process whose number the file TARGET holds,
# leaves the exit status in $status. Each rank writes its number to rank.N.
run() {
  name=$1 target=$2 signal=$3
  shift 3
  rm -f history.csv result.e rank.* pid
  "$@" > log 2>&1 &
  echo $! > pid
  wait_for_lines "$name"
  kill "-$signal" "$(cat "$target")" || fail "$name: no process to signal"
  wait "$(cat pid)"
  status=$?
}

run_and_check() {
  run "$@"
  check_results "$1"
}

# $$ stays the number of the process through exec.
cat > start <<END
echo \$\$ > rank.\${OMPI_COMM_WORLD_RANK:-\${PMI_RANK:-0}}
exec "$strut" deck.xml
END

conditions=$(condition twist "Initial Velocity" all x "10*sin(500*z)") solver="" frequency=20
write_deck
for signal in TERM INT USR1 USR2 HUP XCPU; do
  run_and_check "one process, SIG$signal" pid $signal "$strut" deck.xml
  [ $status -eq 3 ] || { fail "one process, SIG$signal: exit status $status, expected 3"; cat log; }
  [ -e deck.restart.lock ] && fail "one process, SIG$signal: the lock stays"
done

# A run that nohup started goes on when its terminal is gone.
rm -f history.csv
nohup "$strut" deck.xml > log 2>&1 &
echo $! > pid
wait_for_lines "nohup"
kill -HUP "$(cat pid)"
sleep 0.5
kill -TERM "$(cat pid)" || fail "nohup: SIGHUP has ended the run"
wait "$(cat pid)"

# Who reads what the run says goes after the first line: the run goes on, and ends as it would.
rm -f history.csv
mkfifo said
head -n 1 < said > /dev/null &
"$strut" deck.xml > said 2> log &
echo $! > pid
wait_for_lines "a reader that goes"
kill -TERM "$(cat pid)" || fail "a reader that goes: the run has ended"
wait "$(cat pid)"
status=$?
[ $status -eq 3 ] || fail "a reader that goes: exit status $status, expected 3"

# mpirun has the status of its ranks. Where Open MPI's is told to end itself, it kills, after a second, ranks that may
# still write, and SIGUSR1 it hands on; MPICH's hands all three on and waits, and now and then ends with 0 then.
told_to_end="3 0" handed_on="3 0"
case $("$1" --version 2> /dev/null) in *"Open MPI"* | *OpenRTE*) told_to_end=1 handed_on=3 ;; esac
is_one_of() { case " $1 " in *" $status "*) ;; *) return 1 ;; esac; }
run_and_check "SIGTERM to the second of two ranks" rank.1 TERM "$@" -n 2 sh ./start
[ $status -eq 3 ] || fail "SIGTERM to a rank: mpirun ends with $status, expected 3"
run_and_check "SIGUSR1 to mpirun" pid USR1 "$@" -n 2 sh ./start
is_one_of "$handed_on" || fail "SIGUSR1 to mpirun: mpirun ends with $status, expected $handed_on"
checkpoint=$(sed -n 's/^ended by a signal.* goes on from t = .*(\(.*\))$/\1/p' log)
[ -s "$checkpoint" ] || { fail "SIGUSR1 to mpirun: no checkpoint is left"; cat log; }
for signal in INT TERM; do
  run "SIG$signal to mpirun" pid $signal "$@" -n 2 sh ./start
  is_one_of "$told_to_end" || fail "SIG$signal to mpirun: it ends with $status, expected $told_to_end"
done

# Wall time, of two ranks whose clocks differ by their start: both end at the same step, with what a signal leaves.
solver='<Parameter name="Wall Time" type="double" value="1.5"/>'
write_deck
rm -f history.csv result.e deck.restart
"$@" -n 2 "$strut" deck.xml > log 2>&1 && fail "wall time: mpirun reports success"
grep -q "ended by its Wall Time; 'strut --continue deck.xml' goes on from" log || { fail "wall time: no such end is told"; cat log; }
check_results "wall time"

# The same of a run by equilibria.
conditions=$(for axis in x y z; do
  condition "low $axis" "Prescribed Displacement" low $axis 0
  condition "high $axis" "Prescribed Displacement" high $axis "1e-5*t"
done)
solver='<ParameterList name="QuasiStatic"><Parameter name="Number of Load Steps" type="int" value="100000"/></ParameterList>'
frequency=1
write_deck
run_and_check "equilibria, SIGTERM" pid TERM "$strut" deck.xml
[ $status -eq 3 ] || { fail "equilibria, SIGTERM: exit status $status, expected 3"; cat log; }

[ $failures -eq 0 ] && echo "passed"
exit $((failures > 0))
