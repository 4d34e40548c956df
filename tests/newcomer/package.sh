#!/bin/sh
# package.sh CPACK BUILD VERSION: the package of Debian that cpack makes of a build states its dependencies, apt finds all of
# them for a system that has no package yet, and what is in it runs from a folder that it is unpacked into.
cpack=$1 build=$2 version=$3
. "$(dirname "$0")/folder.sh"
cd "$folder" || exit 1
for program in dpkg-deb dpkg-shlibdeps; do
  command -v $program > /dev/null || { echo "skipped: no $program"; exit 77; }
done

"$cpack" -G DEB --config "$build/CPackConfig.cmake" -B "$folder/packed" > log 2>&1 || { fail "cpack"; exit 1; }
deb=$(ls packed/strut_${version}_*.deb) || { fail "there is no package strut_$version"; exit 1; }
needs=$(dpkg-deb -f "$deb" Depends)
for package in openmpi-bin python3-numpy libexodusii libtrilinos-tpetra libopenmpi3; do
  case $needs in *$package*) ;; *) fail "it does not depend on $package: $needs" ;; esac
done
if command -v apt-get > /dev/null && apt-cache show libexodusii5 > /dev/null 2>&1; then  # apt's lists are here
  apt-get install --simulate --no-install-recommends -o Dir::State::status=/dev/null "./$deb" > log 2>&1 ||
    fail "apt cannot install it on a new system"
  for package in strut libexodusii5 openmpi-bin; do
    grep -q "^Inst $package " log || fail "apt does not install $package with it"
  done
fi
dpkg-deb -x "$deb" unpacked || { fail "it cannot be unpacked"; exit 1; }
. "$(dirname "$0")/installed.sh"
looks_installed unpacked/usr
unpacked/usr/bin/strut --version > log 2>&1 && grep -q "^strut $version " log || fail "the program does not start"
cp unpacked/usr/share/strut/inputs/taylor/bar.recipe .
sed 's/"Final Time" type="double" value="[^"]*"/"Final Time" type="double" value="2e-6"/' \
  unpacked/usr/share/strut/inputs/taylor/taylor-C-50.xml > bar.xml
unpacked/usr/share/strut/tools/run -np 1 bar.xml > log 2>&1 || fail "tools/run: exit status $?"
exit $failed
