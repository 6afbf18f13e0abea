"""The pages, one question per module: a form, an answer, a template."""
