"""A team night as it is run: what happened, one event after another, and the state that follows."""
