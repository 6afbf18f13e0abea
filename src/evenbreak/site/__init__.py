"""A league as a static site: pages, pictures and tables in a folder, for any web host."""
