"""Declaring a question: value types, fields, and what interfaces derive from them."""
