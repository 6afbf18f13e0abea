"""Brackets: who plays whom, and where winners and losers go."""
