"""`evenbreak demo`: made-up files to try the commands on."""

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces

EXAMPLES = """\b
Examples:
  evenbreak demo
  evenbreak demo data
"""


@click.command("demo", epilog=EXAMPLES)
@click.argument("folder", metavar="[FOLDER]", default="evenbreak-demo", required=False)
@faces(always_text=True)
def command(*, folder: str) -> Answer:
    """Write made-up files to FOLDER, and show three commands to try on them.

    There are a league's results, the players of a tournament, two teams and a player's practice.
    FOLDER is evenbreak-demo unless given. A file there that is not the demo's is left alone.
    """
    from evenbreak.answers.written import demo_answer
    from evenbreak.files.demo import DEMO, write_demo

    return demo_answer(folder, DEMO, write_demo(folder))
