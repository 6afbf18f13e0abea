"""How far ratings can be trusted: a season predicted date by date, and what came of it."""
