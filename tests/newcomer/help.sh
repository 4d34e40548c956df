#!/bin/sh
# help.sh STRUT TOOL…: --help is the program's own page and names every option; wrong words are told for what they are.
# --help of the tools begins with their usage.
strut=$1
shift
failed=0

fail() {
  echo "FAILED: $1"
  failed=1
}

# says STATUS TEXT WORD…: strut WORD… ends with the status, and TEXT is in what it says.
says() {
  status=$1 text=$2
  shift 2
  said=$("$strut" "$@" 2>&1)
  found=$?
  [ $found = "$status" ] || fail "strut $*: status $found, expected $status"
  case $said in
    *"$text"*) ;;
    *) fail "strut $*: expected '$text' in: $said" ;;
  esac
}

unset OMPI_COMM_WORLD_SIZE PMI_SIZE SLURM_STEP_NUM_TASKS
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
page=$("$strut" --help)
case $page in
  strut:*) ;;
  *) fail "strut --help does not begin with its own page: $page" ;;
esac
for tool in "$@"; do
  page_of_tool=$("$tool" --help) || fail "$tool --help: status $?"
  case $page_of_tool in
    usage:*) ;;
    *) fail "$tool --help does not begin with its usage: $page_of_tool" ;;
  esac
done
# Every option that the source compares a word with.
for option in $(grep -o '== "-[a-z-]*"' "$(dirname "$0")/../../src/main.cpp" | tr -d '="'); do
  case $page in
    *" $option"*) ;;
    *) fail "strut --help does not name $option" ;;
  esac
done
says 0 "usage" -h
says 0 "strut 0" --version
says 2 "no deck is named"
says 2 "did you mean '--check'?" --chek deck.xml
says 2 "'--continue' needs a deck" --continue
says 2 "there is no option '--kokkos-help'" --kokkos-help
says 2 "does not say what to do" deck.xml --check
says 0 "Blocks > (any name) > Horizon" --explain horizon
says 0 "required; expected a real number > 0, in kg/m³" --explain Density
says 1 "no key or section 'Horizn' (did you mean 'Horizon'?)" --explain Horizn
says 2 "'--explain' needs a key" --explain
says 2 "'--log' needs a file, and a deck" --log log
says 2 "does not say what to do" --log deck.xml deck.xml
log=$(mktemp) || exit 1
# What cannot be printed is an error, but for a reader that has gone.
if [ -w /dev/full ]; then
  said=$("$strut" --keys 2>&1 > /dev/full) && fail "strut --keys on a full disk: status 0"
  [ "$said" = "strut: standard output cannot be written, or not all of it (a full disk?)" ] || fail "a full disk: $said"
fi
{ "$strut" --keys; echo $? > "$log"; } | true
[ "$(cat "$log")" = 0 ] || fail "strut --keys for a reader that has gone: status $(cat "$log")"
: > "$log"
says 1 "nothere.xml: the deck does not exist" --log "$log" nothere.xml
of_log() { tail -n +2 "$log"; }  # the first line says that it is one
[ "$(of_log)" = "strut: nothere.xml: the deck does not exist" ] || fail "the log has: $(cat "$log")"
says 0 "strut 0" --log "$log" --version
[ "$(of_log)" = "$said" ] || fail "the log of --version has: $(cat "$log")"
echo "shape = box" > "$log"
says 1 "'$log' is there and is no log of strut" --log "$log" nothere.xml
[ "$(cat "$log")" = "shape = box" ] || fail "--log has replaced a recipe"
rm -f "$log"
says 1 "'/nowhere/log': cannot create it" --log /nowhere/log nothere.xml
says 1 "nothere.xml: the deck does not exist" nothere.xml

# Two processes that a launcher of another MPI made two runs: the first tells and fails, and neither does anything.
export SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=0
says 1 "one of 2 processes (SLURM_STEP_NUM_TASKS), but each is a run of one rank" nothere.xml
says 0 "strut 0" --version
SLURM_PROCID=1
says 0 "" nothere.xml
[ -z "$said" ] || fail "the second of two such processes says: $said"
SLURM_STEP_NUM_TASKS=1
says 1 "nothere.xml: the deck does not exist" nothere.xml
exit $failed
