"""``python -m benchmarks.mutants``; what its processes do stands in a module that they can import."""

from benchmarks.mutants.command import main

if __name__ == "__main__":
    main()
