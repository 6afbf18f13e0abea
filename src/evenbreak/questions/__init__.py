"""Every question that can be asked, declared once: options, forms and tables are read off it."""
