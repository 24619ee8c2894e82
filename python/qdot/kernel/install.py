"""Tell Jupyter of the kernel: a folder with kernel.json and a logo where Jupyter looks for them."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import site
import sys
import tempfile
from typing import Dict, List, Optional

from ..library import load

_HERE = os.path.dirname(os.path.abspath(__file__))


def specification() -> Dict[str, object]:
    """The contents of kernel.json: how this Python starts the kernel."""
    kernel: Dict[str, object] = {
        "argv": [sys.executable, "-m", "qdot.kernel", "-f", "{connection_file}"],
        "display_name": "qdot",
        "language": "qdot",
        "interrupt_mode": "signal",
        "metadata": {"debugger": False},
    }
    environment = _environment()
    if environment:
        kernel["env"] = environment
    return kernel


def _environment() -> Dict[str, str]:
    """Variables without which the kernel would not find what this process has found."""
    package = os.path.dirname(os.path.dirname(_HERE))
    places = [
        os.path.realpath(place) for place in site.getsitepackages() + [site.getusersitepackages()]
    ]
    environment = {}
    if os.path.realpath(package) not in places:
        environment["PYTHONPATH"] = package
    if os.environ.get("QDOT_LIBRARY"):
        environment["QDOT_LIBRARY"] = os.path.abspath(os.environ["QDOT_LIBRARY"])
    return environment


def _codemirror_mode() -> Optional[str]:
    """The colours of the language for CodeMirror, a file that the build makes; None: it is not there."""
    library = os.path.dirname(os.path.realpath(load().path))
    places = (
        os.path.join(library, "..", "share"),  # build/.libs
        os.path.join(library, "..", "share", "qdot"),  # PREFIX/lib
        os.path.join(library, "..", "..", "share", "qdot"),  # PREFIX/lib/TRIPLET
        os.path.join(
            "/usr/local/share", "qdot"
        ),  # where the loader alone knows the library's place
    )
    for place in places:
        path = os.path.join(place, "codemirror", "qdot.js")
        if os.path.exists(path):
            return os.path.normpath(path)
    return None


def _install(arguments: argparse.Namespace) -> str:
    """Write the folder of the kernel; its path."""
    from jupyter_client.kernelspec import KernelSpecManager

    user, prefix = arguments.user, arguments.prefix
    if arguments.sys_prefix:
        prefix = sys.prefix
    if not user and prefix is None:  # nothing is said: where it works
        if sys.prefix != sys.base_prefix:
            prefix = sys.prefix
        elif os.geteuid() != 0:
            user = True
    with tempfile.TemporaryDirectory() as parent:
        folder = os.path.join(parent, "qdot")
        os.mkdir(folder)
        with open(os.path.join(folder, "kernel.json"), "w", encoding="utf-8") as file:
            json.dump(specification(), file, indent=1)
            file.write("\n")
        shutil.copy(os.path.join(_HERE, "logo-svg.svg"), folder)
        colours = _codemirror_mode()
        if colours is not None:  # Notebook 6 loads it before it opens a notebook of this kernel
            shutil.copy(colours, os.path.join(folder, "kernel.js"))
        os.chmod(folder, 0o755)
        return KernelSpecManager().install_kernel_spec(
            folder, arguments.name, user=user, prefix=prefix
        )


def main(arguments: List[str]) -> int:
    parser = argparse.ArgumentParser(
        prog="python3 -m qdot.kernel",
        description="Tell Jupyter of the kernel `qdot`, or make it forget it.",
    )
    commands = parser.add_subparsers(dest="command", required=True)
    install = commands.add_parser("install", help="tell Jupyter of the kernel")
    place = install.add_mutually_exclusive_group()
    place.add_argument(
        "--user", action="store_true", help="for this user (what a user gets who says nothing)"
    )
    place.add_argument(
        "--sys-prefix",
        action="store_true",
        help="within the folder of this Python or virtual environment",
    )
    place.add_argument("--prefix", metavar="FOLDER", help="within FOLDER/share/jupyter/kernels")
    remove = commands.add_parser("remove", help="make Jupyter forget the kernel")
    for command in (install, remove):
        command.add_argument("--name", default="qdot", help="the name of the kernel; qdot")
    parsed = parser.parse_args(arguments)
    try:
        if parsed.command == "install":
            print(f"installed the kernel in {_install(parsed)}")
        else:
            from jupyter_client.kernelspec import KernelSpecManager

            print(f"removed {KernelSpecManager().remove_kernel_spec(parsed.name)}")
    except ImportError as error:
        said = str(error)
        if (error.name or "").startswith("jupyter"):
            said = "Jupyter's client library is missing (Debian: python3-ipykernel)"
        print(f"python3 -m qdot.kernel: {said}", file=sys.stderr)
        return 1
    except (OSError, KeyError) as error:
        hint = "; `--user` needs no rights" if isinstance(error, PermissionError) else ""
        print(f"python3 -m qdot.kernel: {error}{hint}", file=sys.stderr)
        return 1
    return 0
