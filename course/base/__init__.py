"""What every part stands on: errors, files and inputs, texts, processes."""
