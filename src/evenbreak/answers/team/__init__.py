"""Team nights and team leagues: line-ups, caps, rounds, seasons."""
