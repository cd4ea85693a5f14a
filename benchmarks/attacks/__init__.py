"""What submissions could do to a grader, tried behind every wall that this machine has."""
