#!/bin/sh
# install.sh CMAKE BUILD VERSION: what cmake --install makes of a build runs without sources and build: programs, a deck
# with its recipe, what tools start.
cmake=$1 build=$2 version=$3
. "$(dirname "$0")/folder.sh"
cd "$folder" || exit 1

"$cmake" --install "$build" --prefix "$folder/prefix" > log 2>&1 || { fail "cmake --install"; exit 1; }
share=prefix/share/strut
"prefix/bin/strut" --version > log || fail "the program does not start"
grep -q "^strut $version " log || fail "the version is not the project's, $version"
for file in README.md LICENSE docs/cluster.md docs/theory.md inputs/KEYS.md inputs/taylor/taylor-C-50.xml; do
  [ -f "$share/$file" ] || fail "$file is not there"
done
[ -x "$share/inputs/taylor/table" ] || fail "inputs/taylor/table cannot be started"
[ ! -e "$share/tools/prepare" ] || fail "tools/prepare is there: it would look for sources"
[ -z "$(find $share/tools -name 'packages*')" ] || fail "lists of packages for builds are installed"
find prefix -name '*.cpp' -o -name '*.hpp' > log
[ ! -s log ] || fail "sources are installed"

. "$(dirname "$0")/installed.sh"
looks_installed prefix

# A few steps of a deck that is there, its mesh by its recipe.
mkdir work
cp $share/inputs/taylor/bar.recipe work
sed 's/"Final Time" type="double" value="[^"]*"/"Final Time" type="double" value="2e-6"/' \
  $share/inputs/taylor/taylor-C-50.xml > work/bar.xml
cd work || exit 1
../$share/tools/run -np 2 bar.xml > ../log 2>&1 || { cd ..; fail "tools/run: exit status $?"; exit 1; }
cd ..
prefix/bin/strut-compare work/taylor-C-50.e work/taylor-C-50.e > log 2>&1 || fail "the result cannot be read"

# The program that tools in Python start.
python3 - $share/tools/shared > log 2>&1 << 'END' || fail "tools in Python do not find the program"
import subprocess, sys
sys.path.insert(0, sys.argv[1])
import strut_tools
subprocess.run([strut_tools.program("strut"), "--version"], check=True)
END
exit $failed
