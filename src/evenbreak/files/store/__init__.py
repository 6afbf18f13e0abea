"""What is kept: folders that are written as a whole, and the database of an evening."""
