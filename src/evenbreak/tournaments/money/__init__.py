"""Money: payouts by number of entrants, and the Calcutta."""
