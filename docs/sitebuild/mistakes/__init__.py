"""The common mistakes, each with its picture: what a wrong function makes, beside what the right one makes."""
