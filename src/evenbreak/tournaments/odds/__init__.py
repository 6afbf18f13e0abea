"""Title odds: who finishes where, calculated exactly from each match's chances."""
