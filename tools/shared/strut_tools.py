"""What the Python tools share: how they end with an error, and how they get the packages that they need."""
import os
import subprocess
import sys

PROGRAM = "tools/" + os.path.basename(sys.argv[0])


def fail(text):
    sys.exit(f"{PROGRAM}: {text}")


def install_missing(packages):
    """Debian's packages (by module name), and then this script once more, by Debian's Python, which sees them."""
    import importlib.util

    missing = [package for module, package in packages.items() if importlib.util.find_spec(module) is None]
    if not missing:
        return
    if os.environ.get("STRUT_TOOLS_INSTALLED"):
        fail(f"these packages are installed but cannot be imported: {' '.join(missing)}")
    print("installing", *missing, flush=True)
    root = [] if os.geteuid() == 0 else ["sudo"]
    command = ("export DEBIAN_FRONTEND=noninteractive; apt-get -qq update && "
               "apt-get -qq install -y --no-install-recommends \"$@\" >/dev/null")
    if subprocess.run([*root, "sh", "-c", command, "sh", *missing]).returncode != 0:
        fail(f"these packages could not be installed: {' '.join(missing)}")
    os.environ["STRUT_TOOLS_INSTALLED"] = "1"
    os.execv(sys.executable, [sys.executable, *sys.argv])
