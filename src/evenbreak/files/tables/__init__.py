"""Tables: from the bytes of a file to columns of values, with all that is wrong at once."""
