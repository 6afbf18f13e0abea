"""Lists of players and teams: rosters, entrants, fixtures, and starting ratings."""
