"""Files of match results: columns, conversion to one layout, and doubtful rows."""
