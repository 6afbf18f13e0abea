"""Build the program that needs no Python, for the platform that this runs on: `make bundle`.

It makes an environment of its own, has PyInstaller collect the program there, and packs the folder
as build/evenbreak-VERSION-PLATFORM.zip on Windows, .tar.gz elsewhere (which keep what may be run).
"""

import platform
import shutil
import subprocess
import sys
import tempfile
import venv
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
VENV = ROOT / ".venv-bundle"
NAMES = {"win32": "windows", "darwin": "macos"}


def run(*words: object) -> None:
    """Run a program of the environment; end where it fails."""
    subprocess.run([str(word) for word in words], check=True, cwd=ROOT)


def main() -> None:
    """Build and pack."""
    if not VENV.exists():
        venv.create(VENV, with_pip=True)
    python = VENV / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    run(python, "-m", "pip", "install", "-q", "--upgrade", ".[excel,swiss]", "pyinstaller>=6.22,<7")
    with tempfile.TemporaryDirectory() as place:
        spec = ROOT / "packaging" / "evenbreak.spec"
        log = ["--log-level", "WARN", "-y", "--workpath", f"{place}/work", "--distpath", place]
        run(python, "-m", "PyInstaller", *log, spec)
        (folder,) = Path(place).glob("evenbreak-*")
        strip(folder)
        shutil.copy(ROOT / "LICENSE", folder)
        (folder / "licenses.txt").write_text("\n".join(licenses(python)), "utf-8")
        system = NAMES.get(sys.platform, sys.platform)
        name = f"{folder.name}-{system}-{platform.machine().lower()}"
        kind = "zip" if sys.platform == "win32" else "gztar"
        packed = shutil.make_archive(str(ROOT / "build" / name), kind, place, folder.name)
        size = sum(one.stat().st_size for one in folder.rglob("*") if not one.is_symlink())
    print(f"{packed}: {Path(packed).stat().st_size / 1e6:.0f} MB, {size / 1e6:.0f} MB unpacked")


def licenses(python: Path) -> Iterator[str]:
    """Yield the licenses of Python and of what is in the environment."""
    asked = (
        "import sys, sysconfig; print(sys.base_prefix, *sysconfig.get_paths().values(), sep='\\n')"
    )
    said = subprocess.check_output([python, "-c", asked], text=True).splitlines()
    base, *places = dict.fromkeys(Path(one) for one in said)
    found = [one for name in ("LICENSE.txt", "lib/python3*/LICENSE.txt") for one in base.glob(name)]
    for place in places:
        found += sorted(place.glob("*.dist-info/**/*[Ll][Ii][Cc][Ee][Nn][CcSs][Ee]*"))
    for one in filter(Path.is_file, found):
        yield f"==== {'/'.join(one.parts[-3:])}\n\n{one.read_text('utf-8', 'replace')}"


def strip(folder: Path) -> None:
    """Take what only debuggers read out of Python itself; some systems' has 16 MB of it."""
    if sys.platform == "linux" and (tool := shutil.which("strip")):
        for library in folder.glob("_internal/libpython*"):
            run(tool, "--strip-unneeded", library)


if __name__ == "__main__":
    main()
