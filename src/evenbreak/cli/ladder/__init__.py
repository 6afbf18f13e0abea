"""`evenbreak ladder`: how far off ratings are in the long run."""
