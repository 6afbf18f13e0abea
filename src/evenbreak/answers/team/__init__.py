"""Team nights and team leagues: lineups, caps, rounds, seasons."""
