"""What a night is made of, whatever is played: a log of events, their fold, and the moves."""
