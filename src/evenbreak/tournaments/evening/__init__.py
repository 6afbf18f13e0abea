"""Running an evening: what happened, one event after another, and the resulting state."""
