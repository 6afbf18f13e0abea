"""Charts: which race for which difference of ratings or levels; audits, designs, fair races."""
