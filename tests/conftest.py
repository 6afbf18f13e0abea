"""What holds for all tests."""

import os
import signal

from hypothesis import settings

# Tests run beside each other; threads of one would wait for those of another.
for library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")

# A slow machine is no failure, and a failure must come again on the next machine.
settings.register_profile("evenbreak", deadline=None, derandomize=True, max_examples=20)
settings.load_profile("evenbreak")

# A shell's background jobs ignore Ctrl-C, and so would every program that a test starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
