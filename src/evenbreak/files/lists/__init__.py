"""Lists of who plays: rosters, entrants, teams, fixtures, and the ratings to start from."""
