"""``python3 -m qdot.kernel``: install the kernel, remove it, or be it, as Jupyter asks."""

import sys


def main() -> int:
    if sys.argv[1:2] and sys.argv[1] in ("install", "remove"):
        from .install import main as install

        return install(sys.argv[1:])
    if len(sys.argv) == 1 or sys.argv[1] in ("-h", "--help"):
        print(
            "python3 -m qdot.kernel install [--user | --sys-prefix | --prefix FOLDER] [--name NAME]\n"
            "python3 -m qdot.kernel remove [--name NAME]\n"
            "\n"
            "Tells Jupyter of the kernel `qdot`, or makes it forget it. Jupyter itself starts the kernel\n"
            "by `python3 -m qdot.kernel -f CONNECTION_FILE`."
        )
        return 0
    try:
        from ipykernel.kernelapp import IPKernelApp
    except ImportError:
        print(
            "python3 -m qdot.kernel: Jupyter's ipykernel is missing (Debian: python3-ipykernel)",
            file=sys.stderr,
        )
        return 1
    from .kernel import QdotKernel

    IPKernelApp.launch_instance(kernel_class=QdotKernel)
    return 0


if __name__ == "__main__":
    sys.exit(main())
