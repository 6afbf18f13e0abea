"""The registry of columns and quantities: what each is called, and how it is shown.

A key is the name in files and JSON, with the unit in it; where one name means different things in
two answers, each meaning has a key of its own. Words may have fields, such as the name of a player,
that an answer fills in. Answers name columns by their keys: see `evenbreak.answers.kit.columns`.
"""
