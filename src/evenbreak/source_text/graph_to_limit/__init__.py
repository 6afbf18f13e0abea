"""The games of the source text from their graphs to their limits, by every way."""
