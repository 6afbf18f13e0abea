"""Make the pictures of the docs, the gallery and the essentials, always the same bytes.

python docs/images/make_images.py
"""

from __future__ import annotations

import contextlib
import re
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path, PurePath
from unittest import mock

from evenbreak.plots.picture import image_bytes, our_look

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))

from at_work import desk, run  # noqa: E402
from doors import DOORS  # noqa: E402
from essentials_page import essentials_page  # noqa: E402
from gallery_page import gallery_page  # noqa: E402
from shown import SHOWN, Shown  # noqa: E402


def drawing_functions(one: Shown) -> Iterator[tuple[str, str]]:
    """Yield module and name of each function that is said to draw a picture."""
    if one.python:
        return
    for module in sorted((ROOT / "src/evenbreak/plots").glob("*.py")):
        for name in one.draws.split():
            if re.search(rf"^def {name}\(", module.read_text("utf-8"), re.MULTILINE):
                yield f"evenbreak.plots.{module.stem}", name


def make(one: Shown, place: Path) -> bytes:
    """Return a picture as its command or its Python makes it.

    A command must draw with the functions that are named beside it.
    """
    written, file = place / one.name, place / PurePath(one.name).name
    if written.exists():
        return written.read_bytes()
    with contextlib.ExitStack() as watch:
        seen = []
        for module, name in drawing_functions(one):
            draw = getattr(import_module(module), name)
            seen.append(mock.Mock(side_effect=draw))
            # A module that has imported it calls it by its own name.
            for holder in [one for one in sys.modules.values() if vars(one).get(name) is draw]:
                watch.enter_context(mock.patch.object(holder, name, seen[-1]))
        for line in (*one.first.splitlines(), *one.then.splitlines()):
            run(line)
        if one.python:
            names: dict[str, object] = {}
            with our_look():
                exec(one.python, names)  # noqa: S102
            kind = "png" if file.suffix == ".png" else "svg"
            file.write_bytes(image_bytes(names["picture"], kind))  # type: ignore[arg-type]
        else:
            run(one.command.replace("FILE", file.name))
    if not all(function.called for function in seen):
        raise RuntimeError(f"{one.name} is not drawn by {one.draws}")
    return (written if written.exists() else file).read_bytes()


def main() -> None:
    """Write every picture beside this file, and the page that shows them."""
    with desk() as place:
        for one in (one for group in SHOWN.values() for one in group):
            (HERE / PurePath(one.name).name).write_bytes(make(one, place))
        essentials = essentials_page()
        for name, draw in DOORS.items():
            (HERE / f"door_{name}.svg").write_text(draw(), encoding="utf-8", newline="\n")
    (HERE.parent / "_static" / "essentials.html").write_text(
        essentials, encoding="utf-8", newline="\n"
    )
    (HERE.parent / "gallery.md").write_text(gallery_page(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
