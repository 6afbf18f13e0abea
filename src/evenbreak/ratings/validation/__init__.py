"""How far ratings can be trusted: a season predicted date by date and compared with its results."""
