"""A league: ratings, matchups, a night's round, seasons, the report."""
