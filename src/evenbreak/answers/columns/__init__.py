"""The registry of columns and quantities: what each is called, and how it is shown.

A key is the name in files and JSON, including the unit; if a name means different things in two
answers, each meaning has its own key. Words may have fields, such as a player's name, that an
answer fills in. Answers name columns by their keys: see `evenbreak.answers.kit.columns`.
"""
