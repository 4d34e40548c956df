#!/bin/sh
# prepare.sh ROOT: tools/prepare in a tree that was copied with its build folder builds the copy, not what it was copied
# from; a build that fails is an error, and its text is told; it installs packages, and never removes one.
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

# Packages: a stand-in for apt and dpkg, with ParaView's Python installed and without a sudo. Nothing that is there may be
# removed, either of two packages will do, and one of the tools' that cannot be had does not stop the build.
mkdir -p bin
cat > bin/dpkg-query <<'END'
#!/bin/sh
for package in "$@"; do :; done
grep -qx "$package" "$THERE" && echo "install ok installed"
END
cat > bin/apt-get <<'END'
#!/bin/sh
echo "$*" >> "$THERE.asked"
case " $* " in
  *" update "*) exit 0 ;;
  *" --no-remove "*) case " $* " in *excludes-another*) echo "E: Packages need to be removed but remove is disabled." >&2; exit 100 ;; esac ;;
  *) echo "packages could be removed" >> "$THERE.wrong" ;;
esac
for word in "$@"; do case $word in -* | install | Dpkg*) ;; *) echo "$word" >> "$THERE" ;; esac; done
END
printf '#!/bin/sh\necho 0\n' > bin/id
chmod +x bin/*
THERE=$PWD/there
export THERE
with_packages() { PATH="$PWD/bin:$PATH" second/tools/prepare "$@" > log 2>&1; }
printf 'python3-paraview\n' > there
printf 'needed\n' > second/tools/packages
printf 'python3-vtk9 | python3-paraview\nexcludes-another\nplain\n' > second/tools/packages-python
with_packages release || fail "a package of the tools that cannot be had stops the build"
[ ! -e there.wrong ] || fail "apt may remove packages"
[ "$(sort there | tr '\n' ' ')" = "needed plain python3-paraview " ] || fail "installed are $(tr '\n' ' ' < there)"
grep -q "python3-vtk9" there.asked && fail "python3-vtk9 is asked for though python3-paraview will do"
grep -q "excludes-another is not installed .*tests that need it are skipped" log || fail "it is not told which package is missing"
printf 'excludes-another\n' > second/tools/packages
with_packages release --target words && fail "a package of the program that cannot be had is no error"
grep -q "could not be installed: excludes-another" log || fail "it is not told which package could not be installed"
: > second/tools/packages

rm second/words
"second/tools/prepare" release --target words > log 2>&1 && fail "a build that fails is no error"
grep -q "words" log || fail "the error of the build is not told"
echo "message(FATAL_ERROR no)" >> second/CMakeLists.txt
"second/tools/prepare" release --target words > log 2>&1 && fail "CMake's error is no error of tools/prepare"
grep -q "FATAL_ERROR\|CMake Error" log || fail "CMake's error is not told"
exit $failed
