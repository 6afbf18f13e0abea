"""Files of match results: their columns, what becomes of them, and what is doubtful in them."""
