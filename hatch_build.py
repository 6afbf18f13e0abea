"""The README for a package index, which has none of the files that it links to."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hatchling.metadata.plugin.interface import MetadataHookInterface

_LINK = re.compile(
    r"""(?P<image><img\s[^>]*?src="(?P<src>[^":]+)"[^>]*>)"""
    r"""|(?<!!)\[(?P<words>[^]]*)\]\((?!\w+:)(?P<target>[^)#\s]+)(?P<anchor>\#[^)\s]*)?\)"""
)


class CustomMetadataHook(MetadataHookInterface):
    """Set the long description when a package is built."""

    def update(self, metadata: dict[str, Any]) -> None:
        """Make the README's links absolute."""
        where = metadata.get("urls", {}).get("Source", "") or repository(os.environ)
        text = Path(self.root, "README.md").read_text("utf-8")
        metadata["readme"] = {
            "content-type": "text/markdown",
            "text": for_an_index(text, where, f"v{metadata['version']}"),
        }


def repository(environment: Mapping[str, str]) -> str:
    """Return the address of the repository in which a workflow builds; none elsewhere."""
    name = environment.get("GITHUB_REPOSITORY", "")
    return f"{environment.get('GITHUB_SERVER_URL', 'https://github.com')}/{name}" if name else ""


def for_an_index(text: str, where: str, tag: str) -> str:
    """Return a text whose links lead to a repository; without its address, words without links.

    >>> for_an_index("[docs](docs/a.md#b), [set up](#set-up)", "https://git.example/pool", "v1")
    '[docs](https://git.example/pool/blob/v1/docs/a.md#b), [set up](#set-up)'
    >>> for_an_index("[docs](docs/a.md)", "", "v1")
    'docs'
    """

    def absolute(found: re.Match[str]) -> str:
        if not where:
            return found["words"] or ""
        if found["image"]:
            return found["image"].replace(found["src"], f"{where}/raw/{tag}/{found['src']}")
        to = f"{where}/blob/{tag}/{found['target']}{found['anchor'] or ''}"
        return f"[{found['words']}]({to})"

    return _LINK.sub(absolute, text)
