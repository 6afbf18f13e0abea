"""Title odds: who finishes where, worked out exactly from the chances of each match."""
