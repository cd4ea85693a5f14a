"""Shadow rays that need not be sent, by the shafts between cells on surfaces and lights."""
