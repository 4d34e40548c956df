#!/bin/sh
# prepare.sh ROOT: tools/prepare in a tree that was copied with its build folder builds the copy, not what it was copied
# from; a build that fails is an error, and its text is told.
root=$1
. "$root/tests/newcomer/folder.sh" # prepare
cd "$folder" || exit 1

# prepared TREE TEXT: what it built says TEXT.
prepared() {
  "$1/tools/prepare" release --target words > log 2>&1 || fail "$1: tools/prepare failed"
  [ "$(cat "$1/build/release/built")" = "$2" ] || fail "$1: built something else than '$2'"
}

# A project that copies a file into its build folder, without a compiler.
mkdir -p first/tools
cp "$root/tools/prepare" first/tools
: > first/tools/packages
cp "$root/CMakePresets.json" first
cat > first/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(words LANGUAGES NONE)
add_custom_command(OUTPUT built COMMAND cp ${CMAKE_SOURCE_DIR}/words built DEPENDS ${CMAKE_SOURCE_DIR}/words)
add_custom_target(words DEPENDS built)
END
echo "of the first" > first/words
prepared first "of the first"
cp -a first second
echo "of the second" > second/words
prepared second "of the second"
grep -q "is made anew" log || fail "it does not say that the build folder is made anew"
cp second/build/release/build.ninja before
prepared second "of the second"
grep -q "is made anew" log && fail "its own build folder is made anew"
cmp -s before second/build/release/build.ninja || fail "its own build folder has changed"

rm second/words
"second/tools/prepare" release --target words > log 2>&1 && fail "a build that fails is no error"
grep -q "words" log || fail "the error of the build is not told"
echo "message(FATAL_ERROR no)" >> second/CMakeLists.txt
"second/tools/prepare" release --target words > log 2>&1 && fail "CMake's error is no error of tools/prepare"
grep -q "FATAL_ERROR\|CMake Error" log || fail "CMake's error is not told"
exit $failed
