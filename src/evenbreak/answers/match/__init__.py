"""One match: its odds, its length, formats and fair races; games shot by shot."""
