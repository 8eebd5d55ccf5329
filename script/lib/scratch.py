"""A copy of the tree in which sources can be changed and built."""
import shutil
import subprocess
import sys

from lib.bench import ROOT


def quiet(command, cwd, timeout=None):
    """Exit code, or None after the timeout."""
    try:
        return subprocess.run(command, cwd=cwd, timeout=timeout, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, check=False).returncode
    except subprocess.TimeoutExpired:
        return None


def prepare(scratch, *options):
    """Copies the tree and configures a build of the copy; returns both folders."""
    tree, build = scratch / "tree", scratch / "build"
    shutil.rmtree(tree, ignore_errors=True)
    # Without the times: an object built from the last edit of an earlier call would pass for newer than its source.
    shutil.copytree(ROOT, tree, copy_function=shutil.copy, ignore=shutil.ignore_patterns(".git", "build*", "shared", ".cache"))
    if quiet(["cmake", "-S", tree, "-B", build, "-G", "Ninja", *options], tree) != 0:
        sys.exit(f"the copy in {scratch} does not configure")
    return tree, build


def builds(build, *targets):
    return quiet(["ninja", "-C", build, *targets], build) == 0
