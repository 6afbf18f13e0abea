"""Handicap charts: listing, showing, auditing and designing them."""
