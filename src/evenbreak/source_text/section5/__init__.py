"""Section 5 of the source text, regenerated: its tables, problems, numbers, figures, diagrams."""
