"""A league: its results, ratings, races of a night, and whole seasons."""
