"""How a question is declared: the kinds of values, the fields, and what faces read off them."""
