#!/bin/sh
# Makes the packages, looks into them, and uses them unpacked: the command, Python, a C++ project.
#   run.sh SOURCE WORK VERSION LAUNCHER
set -eu
source=$1 work=$2 version=$3 launcher=$4
"$source/script/package"
rm -rf "$work"
mkdir -p "$work/root" "$work/anywhere"
cd "$work"

packages=$source/build/packages
soversion=${version%.*}
library=$(echo "$packages"/libdynamicfilter"$soversion"_*.deb)
dev=$(echo "$packages"/libdynamicfilter-dev_*.deb)
command=$(echo "$packages"/dynamicfilter_*.deb)
python=$(echo "$packages"/python3-dynamicfilter_*.deb)
ros=$(echo "$packages"/dynamicfilter-ros_*.deb)
mpi=$(echo "$packages"/dynamicfilter-mpi_*.deb)
crs=$(echo "$packages"/dynamicfilter-crs_*.deb)
if command -v lintian > /dev/null; then
    lintian --allow-root --fail-on error "$library" "$dev" "$command" "$python" "$ros" "$mpi" "$crs"
else
    echo "lintian is missing: the packages are not checked by it"
fi

holds() {  # PACKAGE PATH...
    package=$1
    shift
    dpkg-deb -c "$package" | sed 's/ -> .*//' > contents
    for path; do
        grep -qE " \./usr/$path\$" contents || { echo "$package holds no $path"; exit 1; }
    done
}
holds_none() {  # PATTERN, of the package asked last
    if grep -E "$1" contents; then exit 1; fi
}
needs() {  # PACKAGE PATTERN...: each matches one that it depends on
    dpkg-deb -f "$1" Depends | sed 's/, /\n/g' > depends
    package=$1
    shift
    for pattern; do
        grep -qxE "$pattern" depends || { echo "$package depends on no $pattern"; exit 1; }
    done
}
ours="libdynamicfilter$soversion \\(= $version-1\\)"
arch='lib/[a-z0-9_-]+-linux-gnu'
for part in "" _io _eval _sim; do
    holds "$library" "$arch/libdynamic_filter$part.so.$soversion"
    holds "$dev" "$arch/libdynamic_filter$part.so"
done
holds "$library" share/doc/libdynamicfilter"$soversion"/copyright
holds_none '/(include|bin|python3)/|\.so$'
needs "$library" 'libc6 .*' 'libtbb12 .*' 'libembree3-3 .*'
holds "$dev" include/dynamic_filter/dynamic_filter.hpp "$arch/cmake/DynamicFilter/DynamicFilterConfig.cmake" \
    share/doc/libdynamicfilter-dev/examples/README.md
holds_none '/bin/|\.a$|\.so\.'
needs "$dev" "$ours" libeigen3-dev
[ "$(wc -l < depends)" -eq 2 ] || { echo "$dev depends on more"; exit 1; }
holds "$command" bin/dynamicfilter share/man/man1/dynamicfilter.1.gz share/bash-completion/completions/dynamicfilter \
    share/doc/dynamicfilter/copyright share/doc/dynamicfilter/changelog.Debian.gz \
    bin/dynamicfilter-slurm share/man/man1/dynamicfilter-slurm.1.gz share/dynamicfilter/dynamicfilter.mk \
    lib/systemd/system/dynamicfilter-live@.service share/doc/dynamicfilter/examples/live.toml \
    share/ament_index/resource_index/packages/dynamicfilter share/dynamicfilter/package.xml lib/dynamicfilter/dynamicfilter \
    share/dynamicfilter/launch/live.launch.xml share/dynamicfilter/config/live.yaml
holds_none '/include/|/lib/[^sd]'
needs "$command" "$ours" 'libc6 .*' 'libfmt9 .*'
if grep -E 'ros|mpi|proj' depends; then echo "$command depends on ROS, MPI or PROJ"; exit 1; fi
holds "$mpi" "$arch/dynamicfilter/libdynamicfilter_mpi.so" share/doc/dynamicfilter-mpi/copyright
holds_none '/(include|bin|python3)/'
needs "$mpi" "dynamicfilter \\(= $version-1\\)" openmpi-bin 'libopenmpi3 .*'
holds "$crs" "$arch/dynamicfilter/libdynamicfilter_crs.so" share/doc/dynamicfilter-crs/copyright
holds_none '/(include|bin|python3)/'
needs "$crs" "dynamicfilter \\(= $version-1\\)" 'libproj25 .*'
holds "$ros" bin/dynamicfilter_ros1 share/man/man1/dynamicfilter_ros1.1.gz share/dynamicfilter_ros/package.xml \
    share/dynamicfilter_ros/dynamicfilter_ros1 share/dynamicfilter_ros/launch/dynamicfilter.launch
holds_none '/(include|lib)/'
needs "$ros" "$ours" 'libroscpp4d .*'
modules=lib/python3/dist-packages
holds "$python" $modules/dynamicfilter/__init__.py $modules/dynamicfilter/__init__.pyi $modules/dynamicfilter/py.typed \
    "$modules/dynamicfilter/_dynamicfilter\\..*\\.so" "$modules/dynamicfilter-$version.dist-info/METADATA"
holds_none '/(include|bin)/'
needs "$python" "$ours" python3-numpy 'python3 \(>= 3\.[0-9]+\)' 'python3 \(<< 3\.[0-9]+\)'

# Unpacked: all the packages in one root, and the tarball somewhere else. Each finds its own libraries.
for package in "$library" "$dev" "$command" "$python" "$ros" "$mpi" "$crs"; do
    dpkg-deb -x "$package" root
done
tar -xzf "$packages"/dynamicfilter-*.tar.gz -C anywhere --strip-components 1
"$source/script/lib/code_of" python "$source/README.md" > lines.py
for prefix in "$work/root/usr" "$work/anywhere"; do
    "$prefix/bin/dynamicfilter" --version | grep -qF "$version"
    "$prefix/bin/dynamicfilter_ros1" --version | grep -qF "$version"
    for program in "$prefix"/bin/dynamicfilter "$prefix"/bin/dynamicfilter_ros1 "$prefix/$modules"/dynamicfilter/_*.so; do
        [ "$(ldd "$program" | grep -c "libdynamic_filter.* => $prefix")" -eq 4 ] ||
            { echo "$program finds not its own libraries"; exit 1; }
    done
    rm -rf demo from_python
    "$prefix/bin/dynamicfilter" simulate crowd -o demo/recording --frames 20
    ! "$prefix/bin/dynamicfilter" run demo/recording --mpi -o none 2> said.txt || { echo "--mpi needs no mpirun"; exit 1; }
    grep -q "Open MPI did not start this process" said.txt || { echo "the plug-in is not found:"; cat said.txt; exit 1; }
    "$prefix/bin/dynamicfilter" convert demo/recording demo/map.las --crs EPSG:32632 --origin 48.1374,11.5755
    PYTHONPATH=$prefix/$modules /usr/bin/python3 lines.py
    PYTHONPATH=$prefix/$modules /usr/bin/python3 -c "
from importlib.metadata import version
assert version('dynamicfilter') == '$version'"
done
if grep -r "$source" root/usr/lib/*/cmake; then exit 1; fi
"$source/tests/consumer/build.sh" "$source" "$work/root/usr" "$work/consumer" "$launcher"

# The manual and the completion know every command.
./anywhere/bin/dynamicfilter --help | sed -n '/^Subcommands:/,$ s/^  \([a-z]*\) .*/\1/p' > commands
[ "$(wc -l < commands)" -gt 5 ]
gunzip -c root/usr/share/man/man1/dynamicfilter.1.gz > manual
while read -r name; do
    grep -qE "^\.BI? (\"dynamicfilter )?$name( |\$)" manual || { echo "no $name in the manual"; exit 1; }
done < commands
bash -c '. root/usr/share/bash-completion/completions/dynamicfilter
         COMP_WORDS=(./anywhere/bin/dynamicfilter "") COMP_CWORD=1
         _dynamicfilter ./anywhere/bin/dynamicfilter
         printf "%s\n" "${COMPREPLY[@]}"' | diff - commands
bash -c '. root/usr/share/bash-completion/completions/dynamicfilter
         COMP_WORDS=(dynamicfilter run --over) COMP_CWORD=2
         _dynamicfilter ./anywhere/bin/dynamicfilter
         printf "%s\n" "${COMPREPLY[@]}"' | grep -qx -- --overwrite
