"""Brackets: who plays who, and where winners and losers go."""
