"""Storage: folders written as a whole, and an evening's database."""
