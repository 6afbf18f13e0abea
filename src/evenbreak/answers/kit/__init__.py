"""The building blocks of answers: the frozen value, its parts, its words, and number formats."""
