"""Questions about known mistakes, from their pictures; `course quiz` and the modules' pages show them."""
