"""The pages, one question a module: a form, an answer, a template."""
