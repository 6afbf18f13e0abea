"""A season of team matches: the table, and how it may end."""
