"""Print the lowest version that pyproject.toml declares for each dependency, as pip constraints."""

import re
import tomllib
from pathlib import Path

project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
extras = project["optional-dependencies"]
for wanted in sorted(
    {*project["dependencies"], *extras["excel"], *extras["symbolic"], *extras["dev"]}
):
    if match := re.fullmatch(r"([\w-]+)>=([\w.]+)", wanted):
        print(f"{match[1]}=={match[2]}")
