"""Practice: drills, scores, runs."""
