"""What answers rays: Embree, and what stands in for it where embreex has no wheel."""
