"""A season of team matches: the table, and the chances of its final places."""
