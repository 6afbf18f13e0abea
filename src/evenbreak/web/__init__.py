"""The page on the director's phone and the venue's screen: questions in forms, answers as pages."""
