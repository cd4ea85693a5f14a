"""The functions that students write: found, checked, and handed to the engine; and what stands in for them."""
