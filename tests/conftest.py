"""What holds for all tests."""

import signal

from hypothesis import settings

# A slow machine is no failure, and a failure must come again on the next machine.
settings.register_profile("evenbreak", deadline=None, derandomize=True)
settings.load_profile("evenbreak")

# A shell's background jobs ignore Ctrl-C, and so would every program that a test starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
