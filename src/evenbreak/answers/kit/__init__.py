"""What answers are made of: the frozen value, its parts, its words, and how numbers are shown."""
