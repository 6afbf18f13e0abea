"""What commands share: options and their values, output, progress, errors."""
