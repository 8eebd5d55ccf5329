#!/bin/sh
# Builds the packages, and looks into them.
#   run.sh BUILD VERSION
set -eu
build=$1 version=$2
work=$build/tests/package
rm -rf "$work"
cpack --config "$build/CPackConfig.cmake" -B "$work" > "$work.log"
cd "$work"

command=$(echo dynamicfilter_*.deb)
dev=$(echo libdynamicfilter-dev_*.deb)
if command -v lintian > /dev/null; then
    lintian --allow-root --fail-on error "$command" "$dev"
fi
holds() {  # PACKAGE PATH...
    package=$1
    shift
    dpkg-deb -c "$package" > contents
    for path; do
        grep -q " \./usr/$path\$" contents || { echo "$package holds no $path"; exit 1; }
    done
}
holds_none() {  # PATTERN, of the package asked last
    if grep -E "$1" contents; then exit 1; fi
}
holds "$command" bin/dynamicfilter share/man/man1/dynamicfilter.1.gz share/bash-completion/completions/dynamicfilter \
    share/doc/dynamicfilter/copyright share/doc/dynamicfilter/changelog.Debian.gz
holds_none '/(include|lib)/'
holds "$dev" include/dynamic_filter/dynamic_filter.hpp lib/libdynamic_filter.a lib/libdynamic_filter_io.a \
    lib/cmake/DynamicFilter/DynamicFilterConfig.cmake share/doc/libdynamicfilter-dev/examples/README.md
holds_none /bin/

dpkg-deb -x "$command" root
mkdir anywhere
tar -xzf dynamicfilter-*.tar.gz -C anywhere --strip-components 1
for program in root/usr/bin/dynamicfilter anywhere/bin/dynamicfilter; do
    "./$program" --version | grep -qF "$version"
done

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
