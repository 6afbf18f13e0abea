"""Charts of races by rating difference or skill level: audits, designs, fair races."""
