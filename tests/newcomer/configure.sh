#!/bin/sh
# configure.sh CMAKE SOURCES: what a build needs and how it compiles, as options say. Nothing is compiled.
cmake=$1 sources=$2
. "$(dirname "$0")/folder.sh"
cd "$folder" || exit 1

# configured NAME OPTION…: in the folder NAME.
configured() {
  name=$1
  shift
  "$cmake" -G Ninja -S "$sources" -B "$name" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" > log 2>&1 || { fail "$name: cannot be configured"; exit 1; }
}

# compiles NAME WORD: some of its lines have the word.
compiles() { grep -q -- "$2" "$1/compile_commands.json" || fail "$1 does not compile with $2"; }
compiles_without() { ! grep -q -- "$2" "$1/compile_commands.json" || fail "$1 compiles with $2"; }

without="-DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON -DCMAKE_DISABLE_FIND_PACKAGE_benchmark=ON"

# The program alone: no tests, no voro++; optimized, for no processor in particular.
configured alone -DSTRUT_TOOLS=OFF $without
compiles alone -O3
compiles alone -fno-math-errno
compiles_without alone -march
compiles_without alone strut-mesh
! grep -qE '^(VORO|GTest_DIR|benchmark_DIR)' alone/CMakeCache.txt || fail "alone looks for what tools and tests need"

# With tools, for a processor; Trilinos by the targets that its packages export (made up: they link nothing).
mkdir trilinos
for package in Tpetra Teuchos Kokkos MueLu Belos Ifpack2 Xpetra Amesos2 Zoltan; do
  cat > trilinos/${package}Config.cmake <<END
add_library($package::all_libs INTERFACE IMPORTED)
target_compile_definitions($package::all_libs INTERFACE BY_TARGET_OF_$package)
END
done
configured targets -DBUILD_TESTING=OFF $without -DSTRUT_PROCESSOR=x86-64-v3 -DCMAKE_PREFIX_PATH="$folder/trilinos"
grep -q "Trilinos: exported targets" log || fail "exported targets of Trilinos are not taken"
for word in -march=x86-64-v3 BY_TARGET_OF_Teuchos BY_TARGET_OF_Kokkos BY_TARGET_OF_Tpetra BY_TARGET_OF_Zoltan BY_TARGET_OF_MueLu; do
  compiles targets $word
done
compiles_without targets "-std=gnu++17"
compiles_without targets "/tests/"
exit $failed
