"""The parts of a night, whatever is played: a log of events, their fold, and the moves."""
