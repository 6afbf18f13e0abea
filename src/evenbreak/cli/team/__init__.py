"""Commands for team nights."""
