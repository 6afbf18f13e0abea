"""The page on the director's phone and the venue's screen: questions as forms, answers as pages."""
