"""The renderers of answers, one per output format: text, CSV, JSON, HTML. None adds a word."""
