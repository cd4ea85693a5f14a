"""The course's modules as they are declared: a file each, and what several of them share."""
