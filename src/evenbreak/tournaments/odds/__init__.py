"""Title odds: who finishes where, exactly, from the chances of each match."""
