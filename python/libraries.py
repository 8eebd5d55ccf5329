# SPDX-License-Identifier: MIT
"""Puts the shared libraries that programs need beside them, so that they run where these are not installed (PEP 600)."""
import hashlib
import pathlib
import re
import subprocess
import sys

# What every system has on which wheels `manylinux` may be installed.
OF_SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|util|pthread|resolv|nsl|anl|gcc_s|stdc\+\+))\.so\.\d+")
# The oldest glibc 2.N beside which systems have a libstdc++ with symbols GLIBCXX_3.4.M: N, M.
LIBSTDCXX = ((35, 30), (39, 33), (42, 34))


def said_by(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def needed_by(file):
    """Names of the libraries that a program or library asks for itself."""
    return re.findall(r"\(NEEDED\).*\[(.+)\]", said_by("readelf", "-d", file))


def found_for(files):
    """Name -> path of all libraries that the files need, also through others, but for those of the system."""
    found = {}
    for file in files:
        loaded = said_by("ldd", file)
        for name, path in re.findall(r"(\S+) => (/\S+)", loaded):
            if not OF_SYSTEM.fullmatch(name):
                found[name] = pathlib.Path(path)
        missing = re.findall(r"(\S+) => not found", loaded)
        if missing:
            sys.exit(f"{file} needs {', '.join(missing)}, which is not installed")
    return found


def least_glibc(files):
    """The second number of the oldest glibc 2.N of systems on which the files run."""
    symbols = "".join(said_by("objdump", "-T", file) for file in files)
    of_glibc = max(int(number) for number in re.findall(r"\*UND\*.*GLIBC_2\.(\d+)", symbols))
    of_libstdcxx = max(int(number) for number in re.findall(r"\*UND\*.*GLIBCXX_3\.4\.(\d+)", symbols))
    return max(of_glibc, next(glibc for glibc, newest in LIBSTDCXX if of_libstdcxx <= newest))


def licence_of(library):
    """Name and text of the copyright file of the Debian package that a library comes from."""
    file = str(library.resolve())
    for path in (file, file.removeprefix("/usr")):  # where /lib leads to /usr/lib, packages may name either
        owner = subprocess.run(["dpkg", "-S", path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
        if owner:
            package = owner.split(":")[0]
            return package, pathlib.Path(f"/usr/share/doc/{package}/copyright").read_bytes()
    sys.exit(f"{library} is of no package, so its licence is not known: a wheel that travels can be built on Debian or Ubuntu")


def bundle(programs, folder):
    """Copies what `programs` need into `folder`, and makes them look there. programs: path -> way from there to the folder.

    Each library gets a name of its own, so that another module of the same process may bring another version. Returns the
    licences: name -> text.
    """
    found = found_for(programs)
    names = {}
    for name, path in found.items():
        stem, ending = name.split(".so", 1)
        names[name] = f"{stem}-{hashlib.sha256(path.read_bytes()).hexdigest()[:8]}.so{ending}"
        copy = folder / names[name]
        copy.write_bytes(path.read_bytes())
        copy.chmod(0o755)
        subprocess.run(["patchelf", "--set-soname", names[name], copy], check=True)
    ways = dict(programs) | {folder / name: "." for name in names.values()}
    for file, way in ways.items():
        replaced = [word for name in needed_by(file) if name in names for word in ("--replace-needed", name, names[name])]
        if replaced:
            subprocess.run(["patchelf", *replaced, file], check=True)  # apart: patchelf 0.14 mixes up what it changes at once
        subprocess.run(["patchelf", "--force-rpath", "--set-rpath", f"$ORIGIN/{way}", file], check=True)
    return dict(licence_of(path) for path in found.values())
