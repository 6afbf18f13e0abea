"""Tables and fixtures: who is ahead of whom, and who plays whom on which date."""
