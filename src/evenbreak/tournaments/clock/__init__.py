"""The clock: how long matches take, when the evening ends, which match to call next."""
