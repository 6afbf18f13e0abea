"""The sentences of answers, as the pages say them."""
