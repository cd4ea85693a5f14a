"""The stress suite: thousands of ill-conditioned scenes, each beside a well-conditioned one that must look alike."""
