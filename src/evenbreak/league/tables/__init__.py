"""Tables and fixtures: who is ahead of whom, and who plays who on which date."""
