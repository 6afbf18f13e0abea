"""The file of a league, `league.toml`: what it holds, and the files that it names."""
