"""Questions to a student about his or her own code: what comes of a change in one place."""
