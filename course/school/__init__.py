"""The course around the renderer: grading, quizzes, and the studio."""
