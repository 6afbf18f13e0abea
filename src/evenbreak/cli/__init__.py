"""The command line: thin click commands, one file a command.

Nothing is computed here: a command reads what a person typed, asks the layers below,
and prints. `base` holds the program itself; a command's module is imported only when
that command runs.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, {"base": ["main"]})
