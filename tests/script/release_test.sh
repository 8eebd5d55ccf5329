#!/bin/sh
# script/release in a small clone: what stops it, and what its source and checksum hold.
#   release_test.sh SOURCE
set -eu
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for file in script tests/script CMakeLists.txt CHANGELOG.md CITATION.cff package.xml pyproject.toml .gitignore packaging python/METADATA.in; do
    mkdir -p "$(dirname "$file")"
    cp -r "$source/$file" "$(dirname "$file")"
done
fail() { echo "release_test: $1" >&2; cat said >&2; exit 1; }
says() { grep -qF "$1" said || fail "does not say: $1"; }
release() { script/release "$@" > said 2>&1; }
commit() { git add -A && git -c user.name=a -c user.email=a@b commit -qm "$1"; }

if release; then fail "released without git"; fi
says "no clone with git"
echo said >> .gitignore
git init -q && commit first
if release --what; then fail "takes any option"; fi
version=$(sed -n 's/^project(DynamicFilter VERSION \([^ ]*\).*/\1/p' CMakeLists.txt)

# The same commit gives the same bytes, and the checksum is theirs.
sed -i "s/^## $version.*/## $version, unreleased/" CHANGELOG.md
git diff --quiet || commit unreleased
release --dry-run || fail "a dry run fails"
says "1 things stand in the way"
says "not 'unreleased'"
(cd build/dist && sha256sum -c --quiet SHA256SUMS) || fail "wrong checksum"
cp build/dist/SHA256SUMS before
echo before >> .git/info/exclude
release --dry-run && cmp before build/dist/SHA256SUMS || fail "other bytes"
tar -xzf build/dist/dynamicfilter-"$version".tar.gz -C build
python3 "build/dynamicfilter-$version/tests/script/versions_test.py" "build/dynamicfilter-$version" > /dev/null ||
    fail "the source names other versions"
if release; then fail "released without a date"; fi

for day in tomorrow "" 2026-13-01; do
    sed -i "s/^## $version.*/## $version, $day/" CHANGELOG.md && commit "$day."
    release --dry-run || fail "a dry run fails"
    says "not '$day'"
done
cp CHANGELOG.md before # what an older version says does not count
{ echo "## $version, 2026-12-01"; sed "s/^## $version.*/## 0.0.1, 2026-01-01/" before; } > CHANGELOG.md && commit empty
release --dry-run || fail "a dry run fails"
says "says nothing about $version"
cp before CHANGELOG.md
sed -i "s/^## $version.*/## $version, 2026-12-01/" CHANGELOG.md && commit dated
release --dry-run || fail "a dry run fails"
if grep -q "stand in the way" said; then fail "something is in the way"; fi

# Whatever is wrong is named at once, and nothing is made.
rm -r build/dist
git tag "v$version"
sed -i 's/^version: .*/version: 9.9.9/' CITATION.cff
if release; then fail "released all the same"; fi
says "not committed"
says "different versions"
says "the tag v$version exists"
[ ! -e build/dist ] || fail "something was made"
