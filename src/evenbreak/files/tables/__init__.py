"""Tables: from a file's bytes to columns of values, reporting all problems at once."""
