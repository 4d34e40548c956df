#!/bin/sh
# run.sh ROOT: tools/run hands on signals, gives the ranks the time to end, and ends with the documented status; after an
# error there is one line. In the place of strut stands a script that does what its deck says, but not at once: Open MPI 6
# takes a program that ends as it begins for one that cannot be started.
root=$1
. "$root/tests/newcomer/folder.sh" # run
cd "$folder" || exit 1

mkdir -p tools build/release
cp "$root/tools/run" tools
printf '#!/bin/sh\n' > tools/prepare
cat > build/release/strut <<'END'
#!/bin/bash
rank=${OMPI_COMM_WORLD_RANK:-$PMI_RANK}
case $1 in
  wrong.xml) sleep 0.2; [ "$rank" != 0 ] || echo "strut: wrong.xml: 1 problem" >&2; exit 1 ;;
  done.xml) exit 0 ;;
esac
ended() { sleep 2; touch "written.$rank"; sleep 0.5; exit 3; }  # a step that takes longer than mpirun's second
trap ended TERM USR1
touch "begun.$rank"
for n in $(seq 300); do sleep 0.1 & wait $!; done
END
mkdir build/release/tools
printf '#!/bin/sh\necho "$2" > "$2"\n' > build/release/tools/strut-mesh
chmod +x tools/prepare build/release/strut build/release/tools/strut-mesh

tools/run -np 2 wrong.xml > log 2>&1
status=$?
[ $status -eq 1 ] || fail "an error: exit status $status, expected 1"
said=$(cat log)
case $(mpirun --version 2> /dev/null) in *"Open MPI) "[5-9]*) said=$(grep '^strut: ' log) ;; esac  # tells it again, in its own words
[ "$said" = "strut: wrong.xml: 1 problem" ] || fail "an error: expected one line"
tools/run -np 2 done.xml > log 2>&1 || fail "a run that is done fails"

# The mesh is made from its recipe, however the deck spells its name.
touch foam.recipe
spelled() {
  rm -f foam.g
  printf "$2" > "done.$1"
  tools/run -np 1 "done.$1" > log 2>&1
  [ -f foam.g ] || fail "the mesh of the deck '$2' is not made"
}
sed -i 's/done.xml/done.*/' build/release/strut
spelled yaml 'Discretization:\n  Input Mesh File: foam.g\n'
spelled yaml 'Discretization:\r\n  "Input Mesh File": '"'foam.g'"' # the foam\r\n'
spelled yaml 'Discretization:\n  # Input Mesh File: old.g\n  Input Mesh File: foam.g  # the foam\n'
spelled yml 'Discretization: {Type: Exodus, Input Mesh File: foam.g, Points: Nodes}\n'
spelled xml '<Parameter name="Input Mesh File" type="string" value="foam.g"/>\n'
spelled xml '<!-- <Parameter name="Input Mesh File" value="old.g"/> -->\n<Parameter value="foam.g"\n name="Input Mesh File"/>\n'

for signal in TERM USR1; do
  rm -f begun.* written.*
  tools/run -np 2 long.xml > log 2>&1 &
  run=$!
  tries=200
  while [ ! -f begun.0 ] || [ ! -f begun.1 ]; do
    tries=$((tries - 1))
    [ $tries -gt 0 ] || { fail "the run has not begun"; break; }
    sleep 0.1
  done
  kill -$signal $run
  wait $run
  status=$?
  [ $status -eq 3 ] || fail "SIG$signal to tools/run: exit status $status, expected 3"
  [ -f written.0 ] && [ -f written.1 ] || fail "SIG$signal to tools/run: the ranks could not write"
done
exit $failed
