"""Tournaments that other programs have saved: one parser each, then results or events of them."""
