"""What holds for all tests."""

from hypothesis import settings

# A slow machine is no failure, and a failure must come again on the next machine.
settings.register_profile("evenbreak", deadline=None, derandomize=True)
settings.load_profile("evenbreak")
