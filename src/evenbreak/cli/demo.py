"""`evenbreak demo`: made-up files to try the commands on."""

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.questions.start import Demo


@command_of(Demo, "demo", always_text=True)
def command(asked: Demo) -> Answer:
    """Write made-up files."""
    from evenbreak.answers.written import demo_answer
    from evenbreak.files.demo import DEMO, write_demo

    return demo_answer(asked.folder, DEMO, write_demo(asked.folder))
