"""The renderers of answers, one a face: text, CSV, JSON, HTML. None of them adds a word."""
