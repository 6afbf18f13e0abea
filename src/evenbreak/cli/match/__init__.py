"""Commands about one match, and about games shot by shot."""
