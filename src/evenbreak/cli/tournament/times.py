"""Times of day as options."""

from __future__ import annotations

import re
from typing import Any

import click


class TimeOfDay(click.ParamType):  # type: ignore[type-arg]
    """A time of day such as 19:30; its value is in minutes after midnight."""

    name = "time"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the minutes."""
        match = re.fullmatch(r"\s*(\d{1,2})[:.h](\d{2})\s*", value)
        hours, minutes = (int(match[1]), int(match[2])) if match else (24, 0)
        if hours > 23 or minutes > 59:
            self.fail(
                f"{value!r}; give a time of day from 0:00 to 23:59, such as 19:30", param, ctx
            )
        return 60 * hours + minutes
